"""Regression: a server that could not be made kept what it had opened so far.

Whatever failed after the session was open left it open for as long as the process lived: the address stayed taken, and
clients connected to a server that never was. `region_rate = 5e-324`, which the settings let through, was enough. And
the recording was begun before anything else, so that a server started a second time by mistake first emptied the
recording of the one that ran, and then said that the address is in use.
"""

from __future__ import annotations

import threading

import pytest

from e2e.processes import free_endpoint
from kuglice.errors import ProtocolError, ReplayError
from kuglice.protocol import close_session, open_session, server_configuration
from kuglice.replay import Replay
from kuglice_server import Server, ServerSettings
from server.small_arena import small_arena


class BrokenError(Exception):
    """What no part of a server raises."""


@pytest.fixture
def settings(tmp_path) -> ServerSettings:
    return ServerSettings(world="small", listen=(free_endpoint(),), record=tmp_path / "run.kuglice")


@pytest.mark.parametrize("part", ["Record", "Publisher", "RegionPublisher", "TickLoop", "Answers"])
def test_whatever_fails_the_address_is_free_again(settings, monkeypatch, part):
    def broken(*_: object, **__: object) -> None:
        raise BrokenError(part)

    monkeypatch.setattr(f"kuglice_server.server.{part}", broken)
    with pytest.raises(BrokenError, match=f"^{part}$"):
        Server(small_arena(), settings)
    if settings.record.exists():
        assert Replay.load(settings.record).complete
    assert close_session(open_session(server_configuration(listen=settings.listen, connect=[])), [])


def test_a_recording_that_cannot_be_begun_leaves_the_address_free(settings):
    settings.record.mkdir()
    with pytest.raises(ReplayError, match="cannot be written"):
        Server(small_arena(), settings)
    assert close_session(open_session(server_configuration(listen=settings.listen, connect=[])), [])


def test_a_second_server_at_an_address_leaves_the_recording_of_the_first_alone(settings):
    with Server(small_arena(), settings) as first:
        first.run(threading.Event(), seconds=0.2)
        recorded = settings.record.read_bytes()
        with pytest.raises(ProtocolError, match="cannot listen"):
            Server(small_arena(), settings)
        assert settings.record.read_bytes() == recorded
    assert len(Replay.load(settings.record)) == first.world.tick > 0


def test_a_scene_of_more_ticks_per_second_than_can_be_told_is_refused(settings):
    scene = small_arena().model_copy(update={"tick_rate": 20_000.0})
    with pytest.raises(ProtocolError, match=r"the scene's tick_rate 20000: must be .* at most 10000"):
        Server(scene, settings)
