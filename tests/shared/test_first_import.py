"""`import kuglice` loads what is used, when it is used."""

from __future__ import annotations

import subprocess
import sys

import pytest

import kuglice as kg

HEAVY = ("numpy", "pydantic", "zenoh", "kuglice._core")


def python(code: str) -> str:
    return subprocess.check_output([sys.executable, "-c", code], text=True, timeout=60)


@pytest.mark.parametrize(
    "code",
    ["import kuglice", "from kuglice.cli import main\ntry: main(['--version'])\nexcept SystemExit: pass"],
)
def test_what_needs_no_world_loads_nothing_heavy(code):
    loaded = python(f"{code}\nimport sys; print([one for one in {HEAVY} if one in sys.modules])")
    assert loaded.splitlines()[-1] == "[]"


@pytest.mark.parametrize(
    "first", ["BallStates", "Kick", "Model", "plan", "Gravity", "World", "loop", "scenes"]
)
def test_every_public_name_is_there_whichever_is_the_first(first):
    code = f"import kuglice as kg; kg.{first}; print([one for one in kg.__all__ if not hasattr(kg, one)])"
    assert python(code) == "[]\n"


def test_a_name_is_the_same_thing_by_every_way():
    same = "from kuglice import World, plan; import kuglice, kuglice.world, kuglice.planner; "
    same += (
        "print(World is kuglice.World is kuglice.world.World, plan is kuglice.plan is kuglice.planner.plan)"
    )
    assert python(same) == "True True\n"


def test_a_command_loads_no_other_room():
    loaded = python(
        "from kuglice.cli import main\ntry: main(['plan', 'cradle', '--json'])\nexcept SystemExit: pass\n"
        "import sys; print(sorted({name.partition('.')[0] for name in sys.modules} & "
        "{'kuglice_server', 'kuglice_client', 'zenoh', 'matplotlib'}))"
    )
    assert loaded.splitlines()[-1] == "[]"


def test_an_unknown_name_is_told():
    with pytest.raises(AttributeError, match="module 'kuglice' has no attribute 'Wrold'"):
        kg.Wrold  # noqa: B018 - looked up is all that it is to be
