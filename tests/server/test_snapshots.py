"""Regression: who asked for the state of now waited until those who had asked before had theirs, over their own links.

States were put into the network one after the other. Of two clients who joined 10,000 balls together, 150 ms away, one
got its state 0.3 s after the other; and a link that stalled held everybody up until it was given up.
"""

from __future__ import annotations

import threading

import pytest

from kuglice.errors import ProtocolError
from kuglice.protocol import decompress
from kuglice_server import snapshots as module
from kuglice_server.history import KeptSnapshot
from kuglice_server.snapshots import THREADS, Snapshots

PATIENCE = 60.0


@pytest.fixture
def snapshots():
    snapshots = Snapshots()
    yield snapshots
    snapshots.undeclare()


def test_nobody_waits_for_the_link_of_another(snapshots):
    stalled, answered = threading.Event(), threading.Event()
    for _ in range(THREADS - 1):
        snapshots.answer(lambda: stalled.wait(PATIENCE))
    snapshots.answer(answered.set)
    assert answered.wait(PATIENCE / 2)
    stalled.set()


def test_who_asks_when_too_many_wait_is_refused_until_one_is_done(monkeypatch):
    monkeypatch.setattr(module, "MOST_WAITING", 2)
    snapshots = Snapshots()
    stalled, done = threading.Event(), threading.Semaphore(0)

    def answer() -> None:
        stalled.wait(PATIENCE)
        done.release()

    snapshots.answer(answer)
    snapshots.answer(answer)
    with pytest.raises(ProtocolError, match="at most 2 allowed"):
        snapshots.answer(answer)
    stalled.set()
    assert done.acquire(timeout=PATIENCE)
    snapshots.undeclare()
    with pytest.raises(ProtocolError, match="this server ends"):
        snapshots.answer(answer)


def test_a_state_is_compressed_once_for_all_who_ask_together(snapshots):
    kept = KeptSnapshot(7, bytes(range(256)) * 1000)
    packed = snapshots.packed(kept)
    assert decompress(packed, max_bytes=len(kept.data)) == kept.data
    assert snapshots.packed(kept) is packed
    other = KeptSnapshot(8, bytes(8000))
    assert decompress(snapshots.packed(other), max_bytes=8000) == other.data
