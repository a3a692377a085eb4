"""What running a replay again has shown."""

from __future__ import annotations

from dataclasses import dataclass

from kuglice.replay.difference import Difference

__all__ = ["Mismatch", "Verification"]


@dataclass(frozen=True, slots=True)
class Mismatch:
    """The first hash that came out differently."""

    tick: int
    """The first differing hash is that of state(tick); the states at the hashes before are equal."""
    expected: int
    found: int
    difference: Difference | None
    """At the first recorded state from then on; None if the recording holds none."""
    only_hash: bool = False
    """That recorded state is equal in every bit: not the world differs but the hash in the file is wrong."""

    @property
    def balls(self) -> tuple[int, ...]:
        """Ids of the balls that differ."""
        return () if self.difference is None else self.difference.balls

    def __str__(self) -> str:
        text = f"tick {self.tick}: hash {self.found:016x} instead of {self.expected:016x}"
        if self.difference is None:
            return f"{text}; no state is recorded from there on that would name the balls"
        if self.only_hash:
            return (
                f"{text}; the recorded state at tick {self.difference.tick} is equal in every bit:"
                " the hash in the file is wrong, no ball differs"
            )
        if self.difference.tick == self.tick:
            return f"{text}; {self.difference}"
        return f"{text}; known from the first recorded state after it: {self.difference}"


@dataclass(frozen=True, slots=True)
class Verification:
    """How far the replay was run, how many hashes were compared, and the first that differed."""

    ticks: int
    hashes: int
    complete: bool
    """Whether the recording was closed; otherwise it was cut off, and is compared as far as it goes."""
    mismatch: Mismatch | None

    @property
    def ok(self) -> bool:
        """Whether every hash was equal."""
        return self.mismatch is None

    def __str__(self) -> str:
        if self.mismatch is not None:
            return f"different from {self.mismatch}"
        counted = f"{self.ticks} ticks, {self.hashes} hashes"
        if not self.complete:
            return f"equal as far as it goes, but not complete: the recording was cut off after {counted}"
        return f"equal: {counted}"
