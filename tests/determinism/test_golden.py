"""Bits that were true once stay true, until STEP_VERSION says otherwise. `make golden` takes new ones."""

from pathlib import Path

import pytest

import kuglice as kg
from determinism import golden
from kuglice import _core

VERSION, STORED = golden.stored()


def test_golden_hashes_are_of_this_version_of_the_step() -> None:
    assert VERSION == _core.STEP_VERSION, "STEP_VERSION has changed: run `make golden`"


@pytest.mark.parametrize(
    ("name", "model"), [pytest.param(*run, id=golden.label(*run)) for run in golden.runs()]
)
def test_the_bits_are_golden(name: str, model: kg.Model) -> None:
    key = golden.label(name, model)
    assert key in STORED, f"no golden hashes of {key!r} yet: run `make golden`"
    now = golden.hashes(name, model)
    assert now[0] == STORED[key][0], (
        "the scene starts from another state: the scene has changed, not the step"
    )
    assert now == STORED[key], "the step gives other bits: raise STEP_VERSION if that was meant"


OLD = {"a": ["01"], "b": ["02"]}


class TestMinting:
    @pytest.fixture
    def file(self, tmp_path: Path) -> Path:
        golden.mint(OLD, tmp_path / "golden.json")
        return tmp_path / "golden.json"

    def test_is_refused_while_the_version_stays(self, file: Path) -> None:
        with pytest.raises(golden.RefusedError, match=f"first 'b'.*still {_core.STEP_VERSION}"):
            golden.mint({"a": ["01"], "b": ["03"]}, file)
        assert golden.stored(file) == (_core.STEP_VERSION, OLD)

    def test_is_refused_when_a_run_would_vanish(self, file: Path) -> None:
        with pytest.raises(golden.RefusedError, match="first 'b'"):
            golden.mint({"a": ["01"]}, file)

    def test_may_add(self, file: Path) -> None:
        assert golden.mint(OLD | {"c": ["04"]}, file) == ["c"]

    def test_may_be_forced(self, file: Path) -> None:
        assert golden.mint({"a": ["01"], "b": ["03"]}, file, force=True) == ["b"]
        assert golden.stored(file)[1]["b"] == ["03"]

    def test_replaces_hashes_of_another_version(self, file: Path) -> None:
        file.write_text(
            file.read_text().replace(f'"step_version": {_core.STEP_VERSION}', '"step_version": 0')
        )
        assert golden.mint({"a": ["05"]}, file) == ["a"]
