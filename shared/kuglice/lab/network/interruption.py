"""Times in which nothing gets through a link: cuts, which lose what is sent meanwhile, and stalls, which hold it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

from kuglice.errors import NetworkError
from kuglice.lab.network.line import Line

__all__ = ["KINDS", "Interruption"]

KINDS = ("cut", "stall")
LONGEST_SECONDS = 3600.0
LATEST_SECONDS = 86_400.0


@dataclass(frozen=True)
class Interruption:
    """`kind`: cut or stall. `seconds`: how long. `at`: seconds after the start of the link. Raises NetworkError.

    Those that overlap last until the last of them is over. A cut of 0 seconds only breaks connections off.
    """

    kind: str
    seconds: float
    at: float = 0.0

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise NetworkError(f"interruption {self.kind!r}: must be one of {', '.join(KINDS)}")
        if not 0.0 <= self.seconds <= LONGEST_SECONDS:
            raise NetworkError(
                f"{self.kind} of {self.seconds:.12g} seconds: must be 0 to {LONGEST_SECONDS:g} seconds"
            )
        if not 0.0 <= self.at <= LATEST_SECONDS:
            raise NetworkError(
                f"{self.kind} at {self.at:.12g} seconds: must be 0 to {LATEST_SECONDS:g} seconds after the start"
            )

    def __str__(self) -> str:
        return f"{self.kind} for {self.seconds:g} s"

    @classmethod
    def parse(cls, kind: str, text: str) -> Self:
        """Of AT:SECONDS: "20:5" begins 20 seconds after the start and lasts 5. Raises NetworkError."""
        at, _, seconds = text.partition(":")
        try:
            numbers = float(seconds), float(at)
        except ValueError:
            raise NetworkError(
                f"{kind} {text!r}: must be AT:SECONDS, like 20:5 for 5 seconds, 20 seconds after the start"
            ) from None
        return cls(kind, *numbers)

    def begin(self, lines: Sequence[Line], now: float) -> None:
        """Interrupt them, in seconds of the clock that their packets are timed by."""
        for line in lines:
            (line.cut if self.kind == "cut" else line.stall)(now + self.seconds)
