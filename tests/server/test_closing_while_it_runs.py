"""Regression: a server that was closed in another thread than the one that runs it ended `run` with an error of Zenoh.

And the recording was closed under the tick that was being made.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest

from e2e.processes import free_endpoint, until
from kuglice.replay import Replay
from kuglice_server import Server, ServerSettings
from server.small_arena import small_arena

SECONDS = 60.0
"""Which only something broken would take."""


@pytest.fixture
def run() -> Iterator[Callable[..., Future[None]]]:
    """Run a server in a thread of its own, until the end of the test at the latest."""
    stop = threading.Event()
    with ThreadPoolExecutor() as threads:

        def running(server: Server, each_tick: Callable[[Server], None] | None = None) -> Future[None]:
            ran = threads.submit(server.run, stop, each_tick=each_tick)
            until(lambda: server.status().tick > 0 or ran.done(), what="a tick")
            return ran

        yield running
        stop.set()


def made(**settings: object) -> Server:
    return Server(small_arena(), ServerSettings(world="closing", listen=(free_endpoint(),), **settings))


def assert_whole(path: Path, server: Server) -> None:
    recorded = Replay.load(path)
    assert recorded.complete
    assert recorded.verify().ok
    assert len(recorded) == server.world.tick


@pytest.mark.parametrize("rate", [10_000.0, 60.0, 0.001])
def test_run_ends_when_it_is_closed_in_another_thread(run, tmp_path, rate):
    """Also where the next tick is a quarter of an hour away."""
    path = tmp_path / "closed.kuglice"
    server = made(rate=rate, record=path)
    ran = run(server)
    assert server.close(SECONDS)
    assert ran.result(SECONDS) is None
    assert_whole(path, server)


def test_rules_of_a_game_may_close_their_own_server(run):
    closed = []

    def rules(server: Server) -> None:
        if server.world.tick == 5:
            closed.append(server.close(SECONDS))

    server = made()
    assert run(server, rules).result(SECONDS) is None
    assert closed == [True]
    assert server.world.tick == 5


def test_a_tick_that_outlasts_the_closing_is_cut_short_and_no_error(run, tmp_path):
    path = tmp_path / "closed.kuglice"
    begun, go_on = threading.Event(), threading.Event()
    server = made(record=path)

    def rules(server: Server) -> None:
        begun.set()
        go_on.wait(SECONDS)
        server.status()

    ran = run(server, rules)
    assert begun.wait(SECONDS)
    assert not server.close(0.05)
    assert not ran.done()
    go_on.set()
    assert ran.result(SECONDS) is None
    assert_whole(path, server)


def test_one_that_is_closed_makes_no_more_ticks_and_may_be_closed_again():
    server = made()
    assert server.close(SECONDS)
    server.run(threading.Event())
    assert server.world.tick == 0
    assert server.close(SECONDS)


def test_errors_of_the_rules_come_out_of_run_all_the_same():
    server = made()

    def rules(server: Server) -> None:
        raise RuntimeError("a bug in the rules")

    with server, pytest.raises(RuntimeError, match="a bug in the rules"):
        server.run(threading.Event(), each_tick=rules)
