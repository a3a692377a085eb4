"""Regression: after a cut of five seconds, clients with datagrams beside the stream heard no ticks any more.

Zenoh came back by itself, over tcp alone and with its keys numbered anew. Messages that come over two links can
overtake those numbers: a tick was taken for something else and dropped, inputs of players came to clients as ticks, and
every second client lived on questions to the history for as long as anybody watched. Now a client with datagrams opens
a session of its own after a cut, under the same name, and has both links again.
"""

from __future__ import annotations

import pytest

from e2e.bad_network import Play
from e2e.processes import until
from kuglice.lab.network import Conditions, open_link
from kuglice.lab.network.tun_device import why_impossible

# Messages overtake each other by jitter alone; what opens a link of datagrams is sent once, and must not be lost.
BAD = Conditions(round_trip=0.15, jitter=0.2, loss=0.0, seed=7)
CUT_SECONDS = 5.0
WATCHED_TICKS = 480
PLAYERS = ("ana", "bob", "eva")


@pytest.mark.skipif(why_impossible() is not None, reason=why_impossible() or "")
def test_after_a_cut_everybody_has_ticks_and_datagrams_again(start, scene, tmp_path):
    with open_link(BAD, "tunnel") as link:
        play = Play(start, scene, tmp_path, link, protocols="tcp+udp")
        players = [play.join(name, "chaser") for name in PLAYERS]
        cut_at = play.recording.go_on(60)
        link.cut(CUT_SECONDS)
        for player in players:
            until(lambda player=player: "opened anew" in player.err, what="the link is opened anew")
        healed_at = play.recording.go_on(WATCHED_TICKS) - WATCHED_TICKS
        assert "leaves" not in play.server.err
        for figures in play.end(*players):
            assert figures["links"] == "tcp+udp"
            assert figures["link_renewals"] >= 1
            assert figures["rejoins"] == 0
            assert figures["malformed_messages"] == 0
            # From the cut until everybody is back, and a lost datagram now and then; not all that came later too.
            assert figures["ticks_healed_by_history"] < healed_at - cut_at + WATCHED_TICKS / 2
