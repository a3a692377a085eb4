"""Real servers of 100 to 1,000,000 balls, each heard by a listener of its ticks and by a view of about 1,000 balls."""

from __future__ import annotations

import json
import math
import tempfile
import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import zenoh

from kuglice.errors import NetworkError, ProtocolError
from kuglice.lab.capacity.processor import processor_seconds
from kuglice.lab.jobs import Job
from kuglice.lab.rows import Row, Rows
from kuglice.processes import CommandProcess, free_port
from kuglice.protocol import (
    Assembly,
    Keys,
    Part,
    Rectangle,
    SnapshotRequest,
    ViewAbout,
    client_configuration,
    close_session,
    decode,
    encode,
    open_session,
)

__all__ = ["SCENES", "jobs", "measured"]

SCENES = (
    "gas:n=100",
    "gas:n=1000",
    "gas:n=10000",
    "gas:n=100000",
    "gas:n=1000000",
    "rain:n=1000",
    "mixed:n=10000",
)
WORLD = "measured"
BALLS_IN_SIGHT = 1000
START_SECONDS = 180.0
ANSWER_SECONDS = 60.0


def jobs(*, scenes: Sequence[str], seconds: float, threads: int) -> list[Job]:
    """One per scene."""
    return [Job(scene, partial(measured, scene, seconds, threads=threads)) for scene in scenes]


def measured(scene: str, seconds: float, *, threads: int = 1, region_rate: float | None = None) -> Rows:
    """One row; `region_rate`: updates per second, None for the server's default. Raises NetworkError."""
    processes: list[CommandProcess] = []
    endpoint = f"tcp/127.0.0.1:{free_port()}"
    with tempfile.TemporaryDirectory() as folder:
        try:
            words = ["server", scene, "--world", WORLD, "--listen", endpoint, "--threads", threads]
            rate = [] if region_rate is None else ["--region-rate", region_rate]
            server = CommandProcess(Path(folder), "server", [*words, *rate])
            processes.append(server)
            server.wait_for_words("balls on", START_SECONDS)
            session = open_session(client_configuration([endpoint], timeout=5.0))
            try:
                return [_row(scene, server, session, endpoint, processes, Path(folder), seconds)]
            finally:
                close_session(session, [], timeout=2.0)
        finally:
            for process in reversed(processes):
                process.end()


def _row(  # noqa: PLR0917 - the parts of one measurement
    scene: str,
    server: CommandProcess,
    session: zenoh.Session,
    endpoint: str,
    processes: list[CommandProcess],
    folder: Path,
    seconds: float,
) -> Row:
    keys = Keys(WORLD)
    about = _about(session, keys)
    snapshot = _snapshot_bytes(session, keys, about.epoch)
    ticks = _Counted()
    listening = session.declare_subscriber(keys.tick, ticks.count)
    corner = _middle(about)
    words = ["view", corner, "--connect", endpoint, "--world", WORLD, "--seconds", seconds, "--json"]
    view = CommandProcess(folder, "view", words)
    processes.append(view)
    view.wait_for_words("looking at world", START_SECONDS)
    began, spent = time.monotonic(), processor_seconds(server.pid)
    ticks.bytes = ticks.messages = 0
    if view.wait(seconds + ANSWER_SECONDS) != 0:
        raise NetworkError(f"{scene}: the view ended with {view.code}:\n{view.words()}")
    took = time.monotonic() - began
    spent = processor_seconds(server.pid) - spent
    listening.undeclare()  # type: ignore[no-untyped-call]
    seen: dict[str, Any] = json.loads(view.stdout())
    error = seen["prediction_error_radii"]
    return {
        "scene": scene,
        "balls": about.balls,
        "snapshot_bytes": snapshot,
        "snapshot_bytes_per_ball": snapshot / about.balls,
        "client_bytes_per_second": ticks.bytes / took,
        "ticks_per_second": ticks.messages / took,
        "server_percent": 100 * spent / took,
        "depth": about.regions.depth,
        "regions_followed": seen["regions_followed"],
        "balls_in_sight": seen["balls_in_sight"],
        "balls_followed": seen["balls_followed"],
        "view_bytes_joining": seen["bytes_joining"],
        "bytes_per_update": seen["bytes_per_update"],
        "bytes_per_ball_told": seen["bytes_per_ball_told"],
        "view_bytes_per_second": seen["bytes_per_second_received"],
        "told_within_radii": seen["told_within_radii"],
        "prediction_error_mean_radii": error["mean"],
        "prediction_error_p99_radii": error["p99"],
    }


class _Counted:
    """What came under a key."""

    def __init__(self) -> None:
        self.messages = 0
        self.bytes = 0

    def count(self, sample: zenoh.Sample) -> None:
        """One more."""
        self.messages += 1
        self.bytes += len(sample.payload)


def _middle(about: ViewAbout) -> str:
    """A rectangle in the middle of the box with about as many balls as wanted, were they spread evenly."""
    left, bottom, right, top = _box(about)
    share = math.sqrt(min(1.0, BALLS_IN_SIGHT / about.balls))
    width, height = share * (right - left), share * (top - bottom)
    return f"{(left + right - width) / 2},{(bottom + top - height) / 2},{width},{height}"


def _box(about: ViewAbout) -> Rectangle:
    left, bottom, right, top = about.scene["box"]
    return left, bottom, right, top


def _about(session: zenoh.Session, keys: Keys) -> ViewAbout:
    deadline = time.monotonic() + START_SECONDS
    while time.monotonic() < deadline:
        for reply in session.get(keys.view, timeout=ANSWER_SECONDS):
            if reply.ok is not None:
                return decode(reply.ok.payload, ViewAbout)
        time.sleep(0.1)
    raise NetworkError(f"{keys.view}: nobody answers")


def _snapshot_bytes(session: zenoh.Session, keys: Keys, epoch: int) -> int:
    """Payload of a whole state as it is sent to one who joins."""
    replies = session.get(
        keys.history,
        zenoh.handlers.FifoChannel(4096),
        payload=encode(SnapshotRequest(epoch=epoch, at=None)),
        consolidation=zenoh.ConsolidationMode.NONE,
        timeout=ANSWER_SECONDS,
    )
    assembly, size = Assembly(), 0
    for reply in replies:
        if reply.ok is None:
            raise NetworkError(f"{keys.history}: no snapshot is given")
        payload = reply.ok.payload
        size += len(payload)
        try:
            if assembly.add(decode(payload, Part)) is not None:
                return size
        except ProtocolError as error:
            raise NetworkError(f"{keys.history}: {error}") from error
    raise NetworkError(f"{keys.history}: some parts of a snapshot are missing")
