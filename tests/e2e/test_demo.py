"""`kuglice demo`, shorter: what it leaves behind, and what its verdict is worth."""

from __future__ import annotations

import json

import av
import pytest

from kuglice.replay import Replay


@pytest.fixture
def shown(start, tmp_path):
    out = tmp_path / "demo"
    command = start("demo", "--seconds", 2, "--size", "320x180", "--out", out)
    assert command.wait(seconds=120) == 0, command.err
    return out, command.out


def test_it_leaves_films_frames_replay_and_figures_and_says_equal(shown):
    out, printed = shown
    summary = json.loads((out / "summary.json").read_text())
    assert summary["agreed"]
    assert printed.rstrip().splitlines()[-1].startswith("EQUAL: chaser and orbiter agreed")
    assert Replay.load(out / "game.kuglice").verify().ok
    for name, client in summary["clients"].items():
        assert client["hashes_checked"] > 60
        assert client["snapshots_checked"] > 0
        # How many there are in two seconds is up to the machine.
        assert client["inputs_accepted"] > 0
        with av.open(str(out / f"{name}.mp4")) as film:
            frames = [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]
        assert len(frames) == client["frames"]
        assert frames[0].shape == (180, 320, 3)
        assert (frames[0] != frames[-1]).any(), "something moved"
        assert len(list(out.glob(f"{name}-*.png"))) >= 3


def test_a_client_that_differs_is_not_called_equal(start, tmp_path):
    """The verdict hangs on the recording too: a client's own word is not enough."""
    from kuglice.demo import _verify  # noqa: PLC0415

    out = tmp_path / "demo"
    command = start("demo", "--seconds", 1, "--no-film", "--out", out, "--json")
    summary = command.figures()
    clients = summary["clients"]
    assert all(_verify(out / "game.kuglice", clients)[1].values())
    clients["chaser"]["final_hash"] = f"{int(clients['chaser']['final_hash'], 16) ^ 1:016x}"
    assert _verify(out / "game.kuglice", clients)[1] == {"chaser": False, "orbiter": True}
