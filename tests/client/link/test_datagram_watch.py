"""Regression: of a link of datagrams that had been up and was lost within seconds it was said that it never came up.

The first look was 4 s after opening; who was stopped before that, and cut off meanwhile, found only the stream then.
"""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass, field

import pytest

from kuglice_client.link import DatagramWatch


@dataclass
class Kinds:
    """All that is looked at of a link."""

    kinds: list[str] = field(default_factory=lambda: ["tcp", "udp"])
    wants_datagrams: bool = True
    owes_datagrams: bool = False


@pytest.mark.parametrize(
    ("was_up", "told"),
    [(True, "the datagram link (udp) is dead"), (False, "the datagram link (udp) never came up")],
)
def test_what_was_up_is_dead_and_what_was_not_never_came_up(caplog, was_up, told):
    caplog.set_level(logging.WARNING)
    link = Kinds() if was_up else Kinds(["tcp"])
    watch = DatagramWatch(link)
    begin = time.monotonic()
    watch.turn(begin + 0.1)
    assert caplog.messages == []
    link.kinds = ["tcp"]
    for seconds in (5.0, 6.5, 8.0):
        watch.turn(begin + seconds)
    assert caplog.messages == [f"{told}: everything goes over tcp alone"]
    link.kinds = ["tcp", "udp"]
    watch.turn(begin + 10.0)
    assert watch.up


def test_what_is_up_early_and_stays_is_not_worth_a_word(caplog):
    caplog.set_level(logging.INFO)
    watch = DatagramWatch(Kinds())
    begin = time.monotonic()
    for tenths in range(100):
        watch.turn(begin + tenths / 10)
    assert caplog.messages == []
    assert watch.up


def test_datagrams_that_are_still_owed_are_not_missed(caplog):
    caplog.set_level(logging.WARNING)
    link = Kinds(["tcp"], owes_datagrams=True)
    watch = DatagramWatch(link)
    begin = time.monotonic()
    watch.turn(begin + 60.0)
    assert caplog.messages == []
    assert not watch.missing
    link.owes_datagrams = False
    watch.turn(begin + 61.0)
    assert watch.missing
