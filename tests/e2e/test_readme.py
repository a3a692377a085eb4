"""What the README shows of Python is run: whoever copies it gets what it says."""

from __future__ import annotations

import re
import threading
from pathlib import Path
from typing import Any

from e2e.processes import free_endpoint
from kuglice import Scene, scenes
from kuglice_client import Client

README = Path(__file__).parents[2] / "README.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", README.read_text(), re.DOTALL | re.MULTILINE)


def one(text: str) -> str:
    """The only block in which that text is."""
    (found,) = [block for block in blocks("python") if text in block]
    return found


def changed(code: str, was: str, becomes: str) -> str:
    assert code.count(was) == 1, f"README: {was!r} once in\n{code}"
    return code.replace(was, becomes)


def run(code: str, names: dict[str, Any]) -> None:
    names["__name__"] = "readme"
    exec(compile(code, str(README), "exec"), names)


def test_a_world_goes_on_from_its_snapshot(capsys):
    run(one("kg.World.restore"), {})
    assert capsys.readouterr().out


def test_the_scene_is_one(tmp_path):
    for number, text in enumerate(blocks("toml")):
        path = tmp_path / f"{number}.toml"
        path.write_text(text)
        assert len(Scene.load(path).balls) > 0


def test_a_game_with_rules_is_played(capsys):
    endpoint = free_endpoint()
    rules = changed(one("ServerSettings"), 'world="goals"', f'world="goals", listen=("{endpoint}",)')
    rules = changed(rules, "threading.Event(), seconds=60", "stop")
    player = changed(one("ClientSettings"), 'name="ada"', f'name="ada", connect=("{endpoint}",), wait=60.0')
    player = changed(player, "    seen =", "    look(client)\n    seen =")
    served: dict[str, Any] = {"stop": threading.Event()}
    played: dict[str, Any] = {}
    first = len(scenes.arena().balls)

    def look(client: Client) -> None:
        played["accepted"] = client.summary()["inputs_accepted"]
        played["gone"] = first - int((client.confirmed.id < first).sum())
        if played["accepted"] and played["gone"]:
            client.stop.set()

    server = threading.Thread(target=run, args=(rules, served))
    server.start()
    try:
        run(changed(player, "seconds=10", "seconds=60"), {"look": look})
    finally:
        served["stop"].set()
        server.join()
    assert played["accepted"] > 0
    assert 0 < played["gone"] <= served["goals"]
    assert "True" in capsys.readouterr().out
