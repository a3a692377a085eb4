"""One game over a conditioned link: a real server and real clients, each a process, judged when it is over."""

from __future__ import annotations

import json
import time
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from kuglice.errors import NetworkError
from kuglice.lab.network.conditioner import Conditioner
from kuglice.lab.network.subjects import Subject
from kuglice.processes import CommandProcess
from kuglice.replay import Replay
from kuglice.study import Study
from kuglice.world import World

__all__ = ["Game", "Outcome"]

START_SECONDS = 60.0
JOIN_SECONDS = 60.0
END_SECONDS = 20.0
POLL_SECONDS = 0.02
RECORDING = "game.kuglice"
SERVER_KINDS = frozenset({"join", "leave"})
"""Inputs that the server writes itself: no client acts by them."""


@dataclass(frozen=True)
class Outcome:
    """What server and clients said at their end. `hashes_equal`: by running the server's recording again."""

    server: dict[str, Any]
    clients: dict[str, dict[str, Any]]
    hashes_equal: bool


class Game:
    """Served and joined when entered; ended, whatever happens, when left. Raises KugliceError.

    `protocols` between server and clients: tcp, or tcp+udp. `folder` takes what the processes write.
    """

    def __init__(
        self,
        link: Conditioner,
        subject: Subject,
        folder: Path,
        *,
        protocols: str = "tcp",
        snapshot_every: int | None = None,
    ) -> None:
        self.subject = subject
        self._link = link
        self._folder = folder
        self._protocols = protocols
        self._snapshot_every = snapshot_every
        self._server: CommandProcess | None = None
        self._clients: dict[str, CommandProcess] = {}

    def __enter__(self) -> Self:
        self._folder.mkdir(parents=True, exist_ok=True)
        scene = self._folder / "scene.toml"
        self.subject.scene.save(scene)
        try:
            self._serve(scene)
            self._join()
        except BaseException:
            self._end()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._end()

    @property
    def acting(self) -> list[str]:
        """Names of the clients that are bots."""
        return self.names[: len(self.subject.bots)]

    @property
    def names(self) -> list[str]:
        """Of the clients: those that act first."""
        bots = [f"{bot}-{number}" for number, bot in enumerate(self.subject.bots)]
        return bots + [f"onlooker-{number}" for number in range(self.subject.onlookers)]

    def play(self, seconds: float) -> None:
        """Let it go on for that long. Raises NetworkError if somebody dies meanwhile."""
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            self._check()
            time.sleep(POLL_SECONDS)

    def finish(self) -> Outcome:
        """End the clients, then the server, and compare everything. Raises NetworkError if one cannot end."""
        for client in self._clients.values():
            client.interrupt()
        for client in self._clients.values():
            self._finished(client)
        assert self._server is not None
        self._server.interrupt()
        self._finished(self._server)
        clients = {name: json.loads(self._summary(name).read_text()) for name in self.names}
        return Outcome(json.loads(self._server.stdout()), clients, self._equal(clients))

    def studies(self) -> dict[str, Study]:
        """What each client saw, once all of them have finished."""
        return {name: Study.load(self._study(name)) for name in self.names}

    def recorded_ticks(self) -> int:
        """How far the server's recording is: about a tick behind the server."""
        return len(Replay.load(self._folder / RECORDING))

    def first_input_after(self, tick: int) -> int | None:
        """The first tick from there on by which each acting client has acted; None if one never did."""
        first: dict[int, int] = {}
        replay = Replay.load(self._folder / RECORDING)
        for number in range(tick, len(replay)):
            for one in replay.inputs(number):
                if one.kind not in SERVER_KINDS:
                    first.setdefault(one.client, number)
        return max(first.values()) if len(first) == len(self.subject.bots) else None

    def _serve(self, scene: Path) -> None:
        listen = ["--listen", f"{self._protocols}/{self._link.server_address}"]
        every = [] if self._snapshot_every is None else ["--snapshot-every", self._snapshot_every]
        self._server = CommandProcess(
            self._folder,
            "server",
            # In a namespace of our own nobody else can reach the address that is not loopback.
            ["server", scene, *listen, "--insecure", *every, "--record", self._folder / RECORDING, "--json"],
            prefix=self._link.server_prefix,
        )
        self._server.wait_for_words("balls on", START_SECONDS)

    def _join(self) -> None:
        connect = ["--connect", f"{self._protocols}/{self._link.client_address}"]
        bots = dict(zip(self.names, self.subject.bots, strict=False))
        for name in self.names:
            self._clients[name] = CommandProcess(
                self._folder,
                name,
                [
                    *("client", *connect, "--name", name, "--wait", JOIN_SECONDS, "--json"),
                    *(("--bot", bots[name]) if name in bots else ()),
                    *(() if self._snapshot_every is None else ("--check-snapshots",)),
                    *("--summary-json", self._summary(name), "--study", self._study(name)),
                ],
                prefix=self._link.client_prefix,
            )
        for client in self._clients.values():
            client.wait_for_words("joined world", JOIN_SECONDS)

    def _check(self) -> None:
        for process in (self._server, *self._clients.values()):
            if process is not None and process.code is not None:
                raise NetworkError(f"{process.name} ended with status {process.code}:\n{process.words()}")

    def _finished(self, process: CommandProcess) -> None:
        code = process.wait(END_SECONDS)
        if code is None:
            raise NetworkError(f"{process.name} did not end in {END_SECONDS:g} s:\n{process.words()}")
        # A client that disagreed ends with 1, which is an outcome and no failure.
        if code not in (0, 1):
            raise NetworkError(f"{process.name} ended with status {code}:\n{process.words()}")

    def _end(self) -> None:
        for process in (*self._clients.values(), self._server):
            if process is not None:
                process.end()

    def _summary(self, name: str) -> Path:
        return self._folder / f"{name}.json"

    def _study(self, name: str) -> Path:
        return self._folder / f"{name}.study"

    def _equal(self, clients: dict[str, dict[str, Any]]) -> bool:
        found: dict[int, str] = {}
        wanted = {client["final_tick"] for client in clients.values()}

        def watch(world: World) -> None:
            if world.tick in wanted:
                found[world.tick] = f"{world.state_hash:016x}"

        verification = Replay.load(self._folder / RECORDING).verify(watch)
        return verification.ok and all(
            client["agreed"] and found.get(client["final_tick"]) == client["final_hash"]
            for client in clients.values()
        )
