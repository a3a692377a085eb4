"""Bytes of payload that a client received and sent, by what they were for."""

from __future__ import annotations

from collections import Counter

__all__ = ["Traffic"]


class Traffic:
    """Counts payload; what TCP and Zenoh wrap around it is not seen here."""

    def __init__(self) -> None:
        self.received: Counter[str] = Counter()
        self.sent: Counter[str] = Counter()

    def per_second(self, seconds: float) -> dict[str, float]:
        """Bytes per second each way over `seconds`; `joining` is what joins and gaps took, told apart."""
        span = max(seconds, 1e-9)
        stream = {kind: count / span for kind, count in self.received.items() if kind != "joining"}
        return {**stream, "received": sum(stream.values()), "sent": sum(self.sent.values()) / span}
