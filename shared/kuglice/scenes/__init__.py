"""Built-in scenes, one file each: functions that return a Scene."""

from kuglice.scenes.arena import arena
from kuglice.scenes.break_ import break_
from kuglice.scenes.cradle import cradle
from kuglice.scenes.dam import dam
from kuglice.scenes.find import find
from kuglice.scenes.gas import gas
from kuglice.scenes.mixed import mixed
from kuglice.scenes.orbit import orbit
from kuglice.scenes.pegs import pegs
from kuglice.scenes.rain import rain
from kuglice.scenes.table import TABLE

__all__ = [
    "TABLE",
    "arena",
    "break_",
    "cradle",
    "dam",
    "find",
    "gas",
    "mixed",
    "orbit",
    "pegs",
    "rain",
]
