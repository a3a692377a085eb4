"""Regression: who joined a large world over a long way saw its last seconds first, played too fast.

The state by which a client joins was up to a second old, was as long on its way again, and the ticks since were asked
for afterwards. All of it was caught up with on screen, which counted as a correction of 0.2 radii per ball and frame of
the whole session. Now the state is one of the moment at which it is asked for, and the first frame shows the present.
"""

from __future__ import annotations

from e2e.processes import until
from e2e.verdict import assert_all_equal
from kuglice import scenes
from kuglice.lab.network import Conditions, ProxyLink
from kuglice.study import Study
from kuglice.study.format import Acted, DrawnFrame
from kuglice_client import Client, ClientSettings

SELDOM = 100_000
"""Ticks from one snapshot to the next: the only one that is made unasked is that of the start."""


def test_the_state_is_made_for_who_asks_and_acts_from_the_present_on(
    start, scene, endpoint, tmp_path, recording
):
    server = start(
        *("server", scene, "--listen", endpoint, "--snapshot-every", SELDOM),
        *("--record", recording.path, "--json"),
    )
    recording.go_on(101)
    settings = ClientSettings(
        connect=(endpoint,), name="ana", bot="chaser", wait=60.0, study=tmp_path / "ana.study"
    )
    with Client(settings) as client:
        # Later the stream itself may lose some.
        asked_for = client.summary()["ticks_healed_by_history"]
        reached = client.confirmed.tick
        until(lambda: client.run(seconds=0.5) or client.confirmed.tick > reached + 30, what="she has played")
        summary = client.summary()
    server.end()
    study = Study.load(tmp_path / "ana.study")
    first = next(event for event in study.events if isinstance(event, DrawnFrame))
    assert study.joined.tick > 100
    assert all(event.tick >= first.tick - 1 for event in study.events if isinstance(event, Acted))
    assert asked_for == 0
    assert_all_equal(recording.path, [summary])


def test_what_happened_while_the_state_was_on_its_way_is_not_shown(start, tmp_path):
    scenes.gas(n=800).save(tmp_path / "gas.toml")
    with ProxyLink(Conditions(round_trip=0.1, bandwidth=20_000.0)) as link:
        record = tmp_path / "run.kuglice"
        server = start(
            "server",
            tmp_path / "gas.toml",
            "--listen",
            f"tcp/{link.server_address}",
            "--record",
            record,
            "--json",
        )
        settings = ClientSettings(
            connect=(f"tcp/{link.client_address}",), study=tmp_path / "eye.study", wait=60.0
        )
        with Client(settings) as client:
            client.run(seconds=0.5)
            summary = client.summary()
        server.signal(2)
        server.figures()
    study = Study.load(tmp_path / "eye.study")
    first = next(event for event in study.events if isinstance(event, DrawnFrame))
    assert first.confirmed - study.joined.tick > 20, "as many as its 22 kB took to come"
    assert_all_equal(record, [summary])
