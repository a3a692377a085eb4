"""`kuglice study`: seconds for people and programs, frames as rows, and a film of what was seen."""

from __future__ import annotations

import json

import pytest
from typer.testing import CliRunner

from kuglice.cli.app import build
from kuglice.study import Study
from kuglice_client.render.seen import film_of_seen
from shared.studied_session import RATE, Session


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "ana.study"
    session = Session(file)
    for _ in range(90):
        session.tick(off=0.04)
    session.recorder.close()
    return file


def test_seconds_for_programs_and_a_row_for_every_frame(path, tmp_path):
    table = tmp_path / "out" / "frames.csv"
    result = CliRunner().invoke(build(), ["study", str(path), "--json", "--csv", str(table)])
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert [row["second"] for row in told["seconds"]] == [0, 1]
    assert told["study"]["own_mean_error_radii"] == pytest.approx(0.1, rel=1e-3)
    assert told["seconds"][0]["worst_error_radii"] == pytest.approx(0.1, rel=1e-3)
    assert len(table.read_text().splitlines()) == 1 + told["study"]["frames_compared"] == 1 + 88


def test_a_table_for_people(path):
    result = CliRunner().invoke(build(), ["study", str(path)])
    assert result.exit_code == 0, result.output
    assert "Study of ana" in result.output


def test_a_film_of_what_was_seen_lasts_as_long_as_that(path, tmp_path):
    result = CliRunner().invoke(
        build(), ["study", str(path), "--render", str(tmp_path / "frame-%05d.png"), "--fps", "10"]
    )
    assert result.exit_code == 0, result.output
    frames = sorted(tmp_path.glob("frame-*.png"))
    assert len(frames) == 1 + int(10 * 87 / RATE)
    assert frames[0].read_bytes() != frames[-1].read_bytes()


def test_balls_are_drawn_where_they_were_seen(path, tmp_path):
    one = next(Study.load(path).seen())
    film_of_seen([one], tmp_path / "seen-%05d.png", size=(320, 180))
    film_of_seen([one._replace(position=one.position + 2.0)], tmp_path / "moved-%05d.png", size=(320, 180))
    seen, moved = ((tmp_path / f"{name}-00000.png").read_bytes() for name in ("seen", "moved"))
    assert seen != moved


def test_keys_for_programs_are_names_and_what_people_read_is_explained(path):
    told = json.loads(
        CliRunner().invoke(build(), ["study", str(path), "--json", "--other", str(path)]).stdout
    )
    for names in (told["study"], told["seconds"][0]):
        assert all(name.isidentifier() for name in names)
    assert set(told["study"]["other_screen_delay_ms"]) == {"ana"}
    result = CliRunner().invoke(build(), ["study", str(path)])
    assert "predicted equal: share of frames whose state had the server's very bits" in result.stderr
