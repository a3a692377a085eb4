"""Regression: what was started a second time by mistake emptied the file that the first was writing.

A server whose address was free emptied the recording of another that ran, and from then on both wrote into it. A client
that nobody let in emptied the study of an earlier session.
"""

from __future__ import annotations

import threading

import pytest

import kuglice as kg
from e2e.processes import free_endpoint
from kuglice.errors import JoinError, ReplayError
from kuglice.replay import Recorder, Replay
from kuglice.study.recorder import StudyRecorder
from kuglice_client import Client, ClientSettings
from kuglice_server import Server, ServerSettings
from server.small_arena import small_arena


def test_a_server_at_another_address_leaves_a_recording_that_is_being_written_alone(tmp_path):
    record = tmp_path / "run.kuglice"
    with Server(
        small_arena(), ServerSettings(world="one", listen=(free_endpoint(),), record=record)
    ) as first:
        first.run(threading.Event(), seconds=0.2)
        recorded = record.read_bytes()
        second = ServerSettings(world="two", listen=(free_endpoint(),), record=record)
        with (
            pytest.raises(
                ReplayError, match=r"run\.kuglice: cannot be written: a server or client that runs"
            ),
            Server(small_arena(), second),
        ):
            pass
        assert record.read_bytes() == recorded
        first.run(threading.Event(), seconds=0.2)
    assert len(Replay.load(record)) == first.world.tick > 0


def test_a_recording_that_has_ended_is_replaced(tmp_path):
    record, world = tmp_path / "run.kuglice", kg.World(small_arena())
    for ticks in (20, 3):
        with Recorder(record, world) as recorder:
            for _ in range(ticks):
                world.step()
                recorder.add()
        assert len(Replay.load(record)) == ticks


def test_a_study_that_is_being_written_is_left_alone(tmp_path):
    study = tmp_path / "ana.study"
    with StudyRecorder(study), pytest.raises(ReplayError, match="cannot be written"):
        StudyRecorder(study)
    assert study.read_bytes() != b""


def test_a_client_that_nobody_lets_in_leaves_the_study_of_an_earlier_session(tmp_path):
    study = tmp_path / "ana.study"
    study.write_bytes(b"what was seen")
    with pytest.raises(JoinError):
        Client(ClientSettings(connect=(free_endpoint(),), world="small", name="ana", study=study, wait=0.1))
    settings = ServerSettings(world="small", listen=(free_endpoint(),))
    with Server(small_arena(), settings), pytest.raises(JoinError, match="has not let it in"):
        # It answers and does not tick, so that nobody is let in.
        Client(ClientSettings(connect=settings.listen, world="small", name="ana", study=study, wait=0.5))
    assert study.read_bytes() == b"what was seen"


def test_what_is_no_regular_file_can_be_written_to():
    with Recorder("/dev/null", kg.World(small_arena())):
        pass
