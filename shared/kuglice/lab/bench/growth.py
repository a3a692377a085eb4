"""What a ball-step costs among a thousand balls and among a million."""

from __future__ import annotations

from collections.abc import Mapping

from kuglice.lab.bench.case import Contender, Measure, raced
from kuglice.lab.bench.stepping import OURS, contender
from kuglice.scenes import gas

__all__ = ["CASES"]

ARRANGED_TICKS = 72
"""Balls are put in spatial order every 24 ticks: a mean over fewer would leave its cost out, or its fading gain."""
BALL_STEPS = 1_000_000


def _grown(contacts: str) -> Mapping[str, Contender]:
    return {
        f"{balls:,} balls": contender(gas(n=balls), OURS[contacts], max(ARRANGED_TICKS, BALL_STEPS // balls))
        for balls in (1_000, 10_000, 100_000, 1_000_000)
    }


CASES: dict[str, Measure] = {
    f"growth, {contacts}": raced(lambda contacts=contacts: _grown(contacts))  # type: ignore[misc]
    for contacts in ("overlap", "event")
}
