"""Regression: a view said nothing when its server was gone, and nothing when another one had come in its place.

It showed the last picture, as if all was well; a full client tells of both.
"""

from __future__ import annotations

import json
import signal
import time

from e2e.processes import Command, until
from kuglice_client.view import View, ViewSettings


def ended(view: Command) -> dict:
    """Its figures. It has status 1 where the server was gone before it had told anything."""
    assert view.wait() in {0, 1}
    return json.loads(view.out)


def test_a_view_says_that_its_server_is_gone_and_that_another_has_come(start, scene, endpoint, server):
    view = start("view", "0,0,10,10", "--connect", endpoint, "--wait", 60, "--json")
    until(lambda: "looking at world" in view.err, seconds=60.0, what="it looks")
    server.kill()
    until(lambda: "no news of world small for 2 s" in view.err, what="it says that nothing comes")
    start("server", scene, "--listen", endpoint)
    until(lambda: "world small was restarted: looked at again" in view.err, what="it says who runs now")
    assert view.err.count("no news") < 5, "per silence, of which a busy machine has more, and not per look"
    view.signal(signal.SIGINT)
    assert ended(view)["rejoins"] == 1


def test_a_view_whose_server_is_gone_for_good_ends_when_told_to(start, endpoint, server):
    view = start("view", "0,0,10,10", "--connect", endpoint, "--wait", 60, "--json")
    until(lambda: "looking at world" in view.err, seconds=60.0, what="it looks")
    server.kill()
    until(lambda: "no news of world small" in view.err, what="it says that nothing comes")
    assert view.running
    view.signal(signal.SIGINT)
    figures = ended(view)
    assert figures["rejoins"] == 0
    assert figures["links"] == ""


def test_the_picture_of_a_view_says_that_nothing_comes(endpoint, server):
    with View(ViewSettings((0.0, 0.0, 10.0, 10.0), connect=(endpoint,), wait=60.0)) as view:

        def shown(*, silent: bool) -> bool:
            view.turn(time.monotonic())
            return view.moment(1.0).silent is silent

        until(lambda: shown(silent=False) and view.replica.updates > 0, what="news")
        server.kill()
        until(lambda: shown(silent=True), what="the picture says that nothing comes")
