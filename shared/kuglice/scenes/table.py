"""All built-in scenes by name."""

from __future__ import annotations

from collections.abc import Callable

from kuglice.scene import Scene
from kuglice.scenes.arena import arena
from kuglice.scenes.break_ import break_
from kuglice.scenes.cradle import cradle
from kuglice.scenes.dam import dam
from kuglice.scenes.gas import gas
from kuglice.scenes.mixed import mixed
from kuglice.scenes.orbit import orbit
from kuglice.scenes.pegs import pegs
from kuglice.scenes.rain import rain

__all__ = ["TABLE"]

TABLE: dict[str, Callable[..., Scene]] = {
    "gas": gas,
    "rain": rain,
    "break": break_,
    "cradle": cradle,
    "orbit": orbit,
    "pegs": pegs,
    "mixed": mixed,
    "dam": dam,
    "arena": arena,
}
