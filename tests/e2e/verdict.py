"""Did everybody compute the same? Judged by the server's recording, run again here from its first state."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from kuglice.replay import Replay

__all__ = ["CHECKING", "assert_all_equal"]

CHECKING = ("--check-snapshots",)
"""For clients that compare whole states, not hashes alone."""


def assert_all_equal(recording: Path, clients: list[dict[str, Any]], *, complete: bool = True) -> None:
    """The recording repeats bit for bit, and every client ended in a state of it."""
    replay = Replay.load(recording)
    hashes: dict[int, str] = {}
    verification = replay.verify(lambda world: hashes.setdefault(world.tick, f"{world.state_hash:016x}"))
    assert verification.ok, str(verification)
    assert replay.complete == complete
    for client in clients:
        assert client["hashes_checked"] > 0
        assert (client["hash_mismatches"], client["snapshot_mismatches"]) == (0, 0), client
        assert client["agreed"]
        assert hashes[client["final_tick"]] == client["final_hash"], client["name"]
