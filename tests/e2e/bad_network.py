"""A server and clients with a conditioned link between them."""

from __future__ import annotations

import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

from e2e.processes import Command, until
from e2e.verdict import CHECKING, assert_all_equal
from kuglice.lab.network import Conditioner
from kuglice.replay import Replay

__all__ = ["Play"]


class Play:
    """The server runs at once; `protocols` are those of the link between it and its clients."""

    def __init__(
        self,
        start: Callable[..., Command],
        scene: Path,
        folder: Path,
        link: Conditioner,
        protocols: str = "tcp",
    ) -> None:
        self._start = start
        self._link = link
        self._connect = f"{protocols}/{link.client_address}"
        self._recording = folder / "bad.kuglice"
        listen = ("--listen", f"{protocols}/{link.server_address}", "--insecure")
        arguments = ("server", scene, *listen, "--record", self._recording, "--json")
        self.server = start(*arguments, prefix=link.server_prefix)

    def join(self, name: str, bot: str | None = None) -> Command:
        """A client that has joined."""
        acts = () if bot is None else ("--bot", bot)
        client = self._start(
            *("client", *CHECKING, "--connect", self._connect, "--name", name, *acts, "--wait", 30, "--json"),
            prefix=self._link.client_prefix,
        )
        until(lambda: "joined world" in client.err, what=f"{name} joins")
        return client

    def look(self, rectangle: str) -> Command:
        """A view that has begun to look."""
        view = self._start(
            *("view", rectangle, "--connect", self._connect, "--wait", 30, "--json"),
            prefix=self._link.client_prefix,
        )
        until(lambda: "looking at world" in view.err, what="the view looks")
        return view

    def go_on(self, ticks: int) -> int:
        """Let the server run so many ticks more; returns the one that it has reached."""
        until(self._recording.exists, what="a recording")
        wanted = len(Replay.load(self._recording)) + ticks
        until(lambda: len(Replay.load(self._recording)) >= wanted, what=f"{ticks} more ticks")
        return wanted

    def end(self, *clients: Command) -> list[dict[str, Any]]:
        """The figures of the clients, after a check that everybody had the same states."""
        for client in clients:
            client.signal(signal.SIGINT)
        figures = [client.figures() for client in clients]
        self.server.signal(signal.SIGINT)
        self.server.figures()
        assert_all_equal(self._recording, figures)
        return figures
