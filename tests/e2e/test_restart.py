"""A server that is started again is another history: clients notice, join it, and mix nothing up."""

from __future__ import annotations

import time

from e2e.processes import until
from e2e.verdict import assert_all_equal
from kuglice_client import Client, ClientSettings


def test_a_restarted_server_is_noticed_and_joined(start, scene, endpoint, tmp_path):
    arguments = ("server", scene, "--listen", endpoint, "--json", "--record")
    before = start(*arguments, tmp_path / "before.kuglice")
    with Client(
        ClientSettings(connect=(endpoint,), name="ana", bot="chaser", wait=60.0, check_snapshots=True)
    ) as client:

        def turned() -> bool:
            client.turn(time.monotonic())
            return True

        def a_second() -> None:
            reached = client.confirmed.tick
            until(lambda: turned() and client.confirmed.tick > reached + 60, what="a second of a run")

        first = client.replica.joined.epoch
        a_second()
        assert not client.moment(1.0).silent
        before.kill()
        until(lambda: turned() and client.moment(1.0).silent, what="the picture says that nothing comes")
        after = start(*arguments, tmp_path / "after.kuglice")
        until(lambda: turned() and client.replica.joined.epoch != first, what="the new epoch is noticed")
        assert client.replica.joined.epoch > first
        a_second()
        assert not client.moment(1.0).silent
        until(lambda: turned() and client.own is not None, what="a ball in the new world")
        summary = client.summary()
    assert summary["rejoins"] == 1
    assert summary["hashes_checked"] > 60
    after.signal(2)
    after.figures()
    assert_all_equal(tmp_path / "after.kuglice", [summary])
