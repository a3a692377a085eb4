"""What a link does to what passes through it."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Self

from kuglice.errors import NetworkError

__all__ = ["Conditions"]

LONGEST_ROUND_TRIP = 60.0


@dataclass(frozen=True)
class Conditions:
    """One link, the same in both directions; half of the round trip is spent each way.

    `round_trip`: seconds. `jitter`: each packet takes up to this share longer or shorter than the mean.
    `loss`, `duplicate`: probabilities per packet and direction. `reorder`: whether a packet that is faster than
    the one before it overtakes it. `bandwidth`: bytes per second and direction, 0 for no limit. `seed`: of all
    that is random; the nth packet of a direction meets the same fate in every run. Raises NetworkError.
    """

    round_trip: float = 0.0
    jitter: float = 0.0
    loss: float = 0.0
    duplicate: float = 0.0
    reorder: bool = False
    bandwidth: float = 0.0
    seed: int = 1

    def __post_init__(self) -> None:
        if not 0.0 <= self.round_trip <= LONGEST_ROUND_TRIP:
            told, longest = 1000 * self.round_trip, 1000 * LONGEST_ROUND_TRIP
            raise NetworkError(f"round trip {told:.12g} ms: must be 0 to {longest:g} ms")
        for name in ("jitter", "loss", "duplicate"):
            value = getattr(self, name)
            if not 0.0 <= value <= 1.0:
                raise NetworkError(f"{name} {value}: must be 0 to 1")
        if not self.bandwidth >= 0.0:
            raise NetworkError(f"bandwidth {self.bandwidth}: must be 0 (no limit) or more bytes per second")

    def __str__(self) -> str:
        parts = [f"{1000 * self.round_trip:g} ms"]
        if self.jitter:
            parts.append(f"jitter {100 * self.jitter:g} %")
        if self.loss:
            parts.append(f"loss {100 * self.loss:g} %")
        if self.duplicate:
            parts.append(f"duplicates {100 * self.duplicate:g} %")
        if self.reorder:
            parts.append("reordered")
        if self.bandwidth:
            parts.append(f"{self.bandwidth:g} B/s")
        return ", ".join(parts)

    def to_message(self) -> dict[str, Any]:
        """Values that JSON knows."""
        return asdict(self)

    @classmethod
    def from_message(cls, message: dict[str, Any]) -> Self:
        """What `to_message` gave. Raises NetworkError for anything else."""
        try:
            return cls(**message)
        except TypeError as error:
            raise NetworkError(f"conditions: {error}") from error
