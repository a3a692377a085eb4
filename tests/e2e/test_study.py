"""What two players saw, recorded by their own clients, against what the server's world was."""

from __future__ import annotations

from kuglice.study import Study, other_screen_delays, own_screen_delays
from kuglice.study.table import summary

SECONDS = 8
"""A busy machine is late with every input of the first few, and no prediction is right then."""


def test_two_players_record_what_they_saw_and_it_was_the_servers_world(start, server, endpoint, tmp_path):
    names = {"ana": "chaser", "ben": "orbiter"}
    clients = [
        start(
            *("client", "--connect", endpoint, "--name", name, "--bot", bot, "--seconds", SECONDS, "--json"),
            *("--study", tmp_path / f"{name}.study"),
        )
        for name, bot in names.items()
    ]
    played = {client.figures()["name"]: client.figures() for client in clients}
    server.signal(2)
    server.figures()
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
