"""Regression: after a cut, a view with datagrams beside the stream lived on what Zenoh's own reconnecting left it.

That comes back without the datagrams, and with keys numbered anew, by which messages over two links are mixed up
(test_datagrams_after_a_cut.py). Now a view opens a session of its own as a client does, and subscribes again.
"""

from __future__ import annotations

import signal

import pytest

from e2e.bad_network import Play
from e2e.processes import until
from kuglice.lab.network import Conditions, open_link
from kuglice.lab.network.tun_device import why_impossible

# What opens a link of datagrams is sent once, and must not be lost.
BAD = Conditions(round_trip=0.15, jitter=0.2, loss=0.0, seed=11)
CUT_SECONDS = 5.0
WATCHED_TICKS = 300


@pytest.mark.skipif(why_impossible() is not None, reason=why_impossible() or "")
def test_after_a_cut_a_view_is_told_again_and_has_datagrams_again(start, scene, tmp_path):
    with open_link(BAD, "tunnel") as link:
        play = Play(start, scene, tmp_path, link, protocols="tcp+udp")
        view = play.look("2,2,10,8")
        play.recording.go_on(120)
        link.cut(CUT_SECONDS)
        until(lambda: "opened anew" in view.err, what="the link is opened anew")
        reached = play.recording.go_on(WATCHED_TICKS)
        view.signal(signal.SIGINT)
        figures = view.figures()
        play.end()
        assert figures["links"] == "tcp+udp"
        assert figures["link_renewals"] >= 1
        assert figures["rejoins"] == 0
        assert figures["malformed_messages"] == 0
        assert figures["final_tick"] > reached - WATCHED_TICKS / 2, "what it shows is what it is told of, now"
