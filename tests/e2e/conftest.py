"""A scene file and a server for every test that wants one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from e2e.processes import Command, free_endpoint, until
from e2e.recording import Recording
from server.small_arena import small_arena

WORLD = "small"


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / f"{WORLD}.toml"
    small_arena(players=4).save(path)
    return path


@pytest.fixture
def endpoint() -> str:
    return free_endpoint()


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Command]]:
    """Start commands that are ended with the test."""
    with ExitStack() as running:
        yield lambda *arguments, prefix=(): running.enter_context(
            Command(tmp_path, *arguments, prefix=prefix)
        )


@pytest.fixture
def recording(tmp_path: Path) -> Recording:
    return Recording(tmp_path / "run.kuglice")


@pytest.fixture
def join(start: Callable[..., Command], endpoint: str) -> Callable[..., Command]:
    """A client that has joined."""

    def joined(*arguments: object) -> Command:
        client: Command = start("client", "--connect", endpoint, "--wait", 60, *arguments, "--json")
        until(lambda: "joined world" in client.err, what="a client joins")
        return client

    return joined


@pytest.fixture
def server(start: Callable[..., Command], scene: Path, endpoint: str, recording: Recording) -> Command:
    """Serves the small arena and records it; prints figures as JSON when it ends."""
    return start(
        "server",
        scene,
        "--listen",
        endpoint,
        "--record",
        recording.path,
        "--snapshot-every",
        20,
        "--json",
    )
