"""A server in a thread of the test's own process, to look into while it ticks."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from e2e.processes import free_endpoint
from kuglice_server import Server, ServerSettings
from server.small_arena import small_arena

__all__ = ["serving"]


@contextmanager
def serving(world: str, each_tick: Callable[[Server], None] | None = None) -> Iterator[tuple[str, Server]]:
    """An endpoint, and the server of a small arena there, ticking."""
    endpoint, stop = free_endpoint(), threading.Event()
    with Server(small_arena(), ServerSettings(world=world, listen=(endpoint,))) as server:
        thread = threading.Thread(target=server.run, args=(stop,), kwargs={"each_tick": each_tick})
        thread.start()
        try:
            yield endpoint, server
        finally:
            stop.set()
            thread.join()
