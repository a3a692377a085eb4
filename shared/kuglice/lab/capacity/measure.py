"""The ladder: more and more clients until a tick is late or a client misses one."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import zenoh

from kuglice.errors import NetworkError
from kuglice.lab.capacity.crowd import Crowd
from kuglice.lab.capacity.processor import processor_seconds
from kuglice.lab.jobs import Job
from kuglice.lab.rows import Row, Rows
from kuglice.processes import CommandProcess, free_port
from kuglice.protocol import Keys, Status, client_configuration, close_session, decode, open_session

__all__ = ["LADDER", "ROUTERS", "jobs"]

SCENES = {"client": "arena:players=4,balls=600", "view": "gas:n=10000"}
"""By what listens: a full client hears ticks, a view the regions of a part of a larger crowd."""
KINDS = tuple(SCENES)
WORLD = "crowded"
PLAYERS = ("chaser", "orbiter")
"""Real clients that play all the time, so that ticks have inputs in them."""
LADDER = (8, 32, 64, 128, 192, 256, 320, 384, 512)
ROUTERS = (0, 1, 2)
SETTLE_SECONDS = 2.0
"""At most: no longer than a rung is measured."""
START_SECONDS = 60.0


@dataclass
class _House:
    """A server, its routers, the players, and a session that asks how it goes."""

    server: CommandProcess
    routers: list[CommandProcess]
    doors: list[str]
    """Endpoints that clients connect to."""
    session: zenoh.Session

    def status(self) -> Status:
        for reply in self.session.get(Keys(WORLD).status, timeout=5.0):
            if reply.ok is not None:
                return decode(reply.ok.payload, Status)
        raise NetworkError(f"world {WORLD}: the server does not answer")

    def processor_seconds(self) -> tuple[float, float]:
        """Of the server, and of all routers."""
        return (
            processor_seconds(self.server.pid),
            sum(processor_seconds(router.pid) for router in self.routers),
        )


def jobs(
    *, routers: Sequence[int], ladder: Sequence[int], seconds: float, kinds: Sequence[str] = KINDS
) -> list[Job]:
    """One per kind of listeners and number of routers."""
    return [
        Job(
            f"{_topology(number)}, up to {ladder[-1]} {kind}s",
            partial(_climb, kind, number, ladder, seconds),
        )
        for kind in kinds
        for number in routers
    ]


def _topology(routers: int) -> str:
    return ("direct", "one router", "two routers")[routers]


def _climb(kind: str, routers: int, ladder: Sequence[int], seconds: float) -> Rows:
    rows: list[Row] = []
    with (
        tempfile.TemporaryDirectory() as folder,
        _house(Path(folder), kind, routers) as house,
        Crowd(WORLD, kind) as crowd,
    ):
        listeners = 0
        for rung in ladder:
            _grow(crowd, house.doors, rung - listeners)
            listeners = rung
            row = _measure(house, crowd, listeners, seconds)
            rows.append({"kind": kind, "topology": _topology(routers), **row})
            if row["late_ticks"] or row["missed_permille"]:
                break
    return rows


def _grow(crowd: Crowd, doors: Sequence[str], sessions: int) -> None:
    for number, door in enumerate(doors):
        share = sessions // len(doors) + (number < sessions % len(doors))
        crowd.grow(share, door)


def _measure(house: _House, crowd: Crowd, listeners: int, seconds: float) -> Row:
    time.sleep(min(SETTLE_SECONDS, seconds))
    crowd.heard()
    before, began = house.status(), time.monotonic()
    server, routers = house.processor_seconds()
    idle = crowd.processor_seconds
    time.sleep(seconds)
    spent = time.monotonic() - began
    server, routers = (
        now - then for now, then in zip(house.processor_seconds(), (server, routers), strict=True)
    )
    listening = crowd.processor_seconds - idle
    after, heard = house.status(), crowd.heard()
    expected = heard.messages + heard.missed
    return {
        "listeners": listeners,
        "players": len(house.status().clients),
        "tick_rate": (after.tick - before.tick) / spent,
        "late_ticks": after.counters["late_ticks"] - before.counters["late_ticks"],
        "missed_permille": 1000.0 * heard.missed / expected if expected else 1000.0,
        "server_percent": 100.0 * server / spent,
        "routers_percent": 100.0 * routers / spent,
        "listeners_percent": 100.0 * listening / spent,
        "bytes_per_second": heard.bytes / listeners / spent,
    }


@contextmanager
def _house(folder: Path, kind: str, routers: int) -> Iterator[_House]:
    processes: list[CommandProcess] = []
    session: zenoh.Session | None = None

    def start(name: str, words: str, *arguments: str) -> CommandProcess:
        process = CommandProcess(folder, name, arguments)
        processes.append(process)
        process.wait_for_words(words, START_SECONDS)
        return process

    try:
        endpoint = f"tcp/127.0.0.1:{free_port()}"
        server = start("server", "balls on", "server", SCENES[kind], "--world", WORLD, "--listen", endpoint)
        doors = [f"tcp/127.0.0.1:{free_port()}" for _ in range(routers)]
        passing_on = [
            start(f"router-{number}", "router from", "router", "--connect", endpoint, "--listen", door)
            for number, door in enumerate(doors)
        ]
        for bot in PLAYERS if kind == "client" else ():
            start(bot, "joined world", "client", "--connect", endpoint, "--bot", bot, "--name", bot)
        session = open_session(client_configuration([endpoint], timeout=5.0))
        yield _House(server, passing_on, doors or [endpoint], session)
    finally:
        if session is not None:
            close_session(session, [], timeout=2.0)
        for process in reversed(processes):
            process.end()
