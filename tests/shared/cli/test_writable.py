"""Where a command is to write is looked at before anything is done, and nothing is made there."""

from __future__ import annotations

import os

import pytest
import typer
from typer.testing import CliRunner

from kuglice.cli.app import build
from kuglice.cli.writable import writable, writable_file, writable_folder


@pytest.fixture
def file(tmp_path):
    made = tmp_path / "file"
    made.write_text("kept")
    return made


@pytest.mark.parametrize("judge", [writable, writable_file, writable_folder])
def test_what_is_not_there_yet_may_be_written_and_is_not_made(judge, tmp_path):
    assert judge(tmp_path / "a" / "b.json") == tmp_path / "a" / "b.json"
    assert judge(None) is None
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_is_there_may_be_replaced_and_is_not_touched(file):
    assert writable_file(file) == file
    assert file.read_text() == "kept"


@pytest.mark.parametrize("judge", [writable, writable_file, writable_folder])
def test_nothing_is_written_below_a_file(judge, file):
    with pytest.raises(typer.BadParameter, match=f"{file}/a/b: cannot be written: {file} is no directory"):
        judge(file / "a" / "b")


def test_a_directory_is_no_file_and_a_file_no_directory(file, tmp_path):
    with pytest.raises(typer.BadParameter, match="must be a file"):
        writable_file(tmp_path)
    with pytest.raises(typer.BadParameter, match="must be a directory"):
        writable_folder(file)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_place_of_others_is_refused(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(typer.BadParameter, match="must not be changed by you"):
        writable_file(tmp_path / "a.json")


@pytest.mark.parametrize(
    "command",
    [
        ["client", "--study"],
        ["client", "--summary-json"],
        ["client", "--render"],
        ["client", "--desync-reports"],
        ["view", "0,0,9,9", "--summary-json"],
        ["view", "0,0,9,9", "--render"],
        ["server", "arena", "--record"],
        ["render", "arena", "--out"],
        ["demo", "--out"],
        ["bench", "--out"],
        ["chart", "--out"],
    ],
    ids=" ".join,
)
def test_every_option_that_names_a_place_is_judged(command, file):
    result = CliRunner().invoke(build(), [*command, str(file / "x")])
    assert result.exit_code == 2
    assert command[-1] in result.output
    assert "cannot be written" in result.output
