"""Threads beside the tick loop."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

__all__ = ["Beside"]


class Beside(ThreadPoolExecutor):
    """Does one thing after the other, or `threads` at a time. Ended as a part of closing a session, and so for no
    longer than that may take: what is put into a stalled network may never be done.
    """

    def __init__(self, name: str, threads: int = 1) -> None:
        super().__init__(threads, thread_name_prefix=name)

    def undeclare(self) -> None:
        """Wait for what is being done, leave out what waits, and end."""
        self.shutdown(cancel_futures=True)
