"""What two players saw, recorded by their own clients, against what the server's world was."""

from __future__ import annotations

from pathlib import Path

from e2e.processes import until
from kuglice.study import Study, other_screen_delays, own_screen_delays
from kuglice.study.table import summary

TICKS = 120


def predicted_right(path: Path) -> bool:
    """Once at least by now. A busy machine is late with every input at first, and no prediction is right then."""
    return any(frame.predicted_equal for frame in Study.load(path).frames())


def test_two_players_record_what_they_saw_and_it_was_the_servers_world(server, join, recording, tmp_path):
    names = {"ana": "chaser", "ben": "orbiter"}
    clients = [
        join("--name", name, "--bot", bot, "--study", tmp_path / f"{name}.study")
        for name, bot in names.items()
    ]
    recording.go_on(TICKS)
    recording.acted(*clients)
    for name in names:
        until(lambda name=name: predicted_right(tmp_path / f"{name}.study"), every=0.5, what="it is right")
    played = {(figures := client.end())["name"]: figures for client in clients}
    server.end()
    ana, ben = (Study.load(tmp_path / f"{name}.study") for name in names)
    for study in (ana, ben):
        frames = list(study.frames())
        figures = summary(study, frames)
        assert figures["frames"] > 30
        assert len(frames) > 30
        assert any(frame.predicted_equal for frame in frames)
        told = played[study.joined.name]
        assert figures["rollbacks"] == told["rollbacks"]
        assert figures["inputs_answered"] == told["inputs_accepted"] + told["inputs_refused"]
        assert len(own_screen_delays(study)) > 0
    assert min(other_screen_delays(ana, ben)) > 0
    assert min(other_screen_delays(ben, ana)) > 0
