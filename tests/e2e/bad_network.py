"""A server and clients with a conditioned link between them."""

from __future__ import annotations

import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

from e2e.processes import Command, until
from e2e.recording import Recording
from e2e.verdict import CHECKING, assert_all_equal
from kuglice.lab.network import Conditioner

__all__ = ["Play"]

PATIENT = ("--grace", 600)
"""Whoever is cut off may take its time to come back."""


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
        self.recording = Recording(folder / "bad.kuglice")
        listen = ("--listen", f"{protocols}/{link.server_address}", "--insecure", *PATIENT)
        arguments = ("server", scene, *listen, "--record", self.recording.path, "--json")
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

    def end(self, *clients: Command) -> list[dict[str, Any]]:
        """The figures of the clients, after a check that everybody had the same states."""
        for client in clients:
            client.signal(signal.SIGINT)
        figures = [client.figures() for client in clients]
        self.server.end()
        assert_all_equal(self.recording.path, figures)
        return figures
