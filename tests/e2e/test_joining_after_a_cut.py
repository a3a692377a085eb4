"""Regression: whoever was joining when its link was lost asked a session that could never come back.

Sessions do not reconnect by themselves; a client opens another one when the stream falls silent. But while it joins it
turns no such clock, and waited for answers on the dead session until its patience was over.
"""

from __future__ import annotations

import threading
import time

from e2e.processes import until
from kuglice.protocol import close_session, open_session, server_configuration
from kuglice_client.join import find_world
from kuglice_client.link import Link, Waiting

DEADLINE_SECONDS = 30.0


def test_a_world_is_found_by_a_session_of_before_the_server_was_there(start, scene, endpoint):
    began = time.monotonic()
    before = open_session(server_configuration(listen=[endpoint], connect=[]))
    link = Link((endpoint,), deadline=began + DEADLINE_SECONDS, stop=threading.Event())
    close_session(before, [])
    until(lambda: not link.kinds, what="the loss of the link")
    server = start("server", scene, "--listen", endpoint, "--json")
    assert find_world(Waiting(link, began=began, wait=DEADLINE_SECONDS, stop=threading.Event()))
    assert link.kinds
    link.close(5.0)
    server.signal(2)
    server.figures()
