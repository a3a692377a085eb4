"""Regression: counts were lost, and a report of them could fail.

The tick counted in a dict that whoever tells regions beside it counted in as well, and that status copied at any time:
reading, adding and writing back are three things, between which another thread may do the same.
"""

from __future__ import annotations

import sys
import threading

import pytest

from kuglice_server.counters import Counters

THREADS, TIMES = 4, 5_000


@pytest.fixture
def often_interrupted():
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def test_what_several_threads_count_adds_up(often_interrupted):
    counters = Counters()

    def count(number: int) -> None:
        for time in range(TIMES):
            counters.add("all")
            counters.add(f"{number} {time % 100}", 2)

    threads = [threading.Thread(target=count, args=(number,)) for number in range(THREADS)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        told = counters.all()
        assert told.get("all", 0) <= counters["all"]
    assert counters["all"] == THREADS * TIMES
    assert sum(counters.all().values()) == 3 * THREADS * TIMES


def test_what_was_never_counted_is_0_and_not_told():
    counters = Counters()
    assert counters["nothing"] == 0
    assert counters.all() == {}
