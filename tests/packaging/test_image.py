"""The image and the compose file, as far as they can be judged without building them."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import typer.main
from ruamel.yaml import YAML

from kuglice.cli.app import build
from kuglice_client.bots import BOTS

ROOT = Path(__file__).resolve().parents[2]
Run = Callable[..., str]

pytestmark = pytest.mark.timeout(900)


def allowed_into_the_image() -> list[str]:
    lines = (ROOT / ".dockerignore").read_text().splitlines()
    return [line.removeprefix("!") for line in lines if line.startswith("!")]


def services() -> dict[str, dict[str, object]]:
    return YAML(typ="safe").load(ROOT / "docker" / "compose.yaml")["services"]


def test_the_install_steps_of_the_image_work_in_an_empty_directory(
    tmp_path: Path, copy_tree: Callable[[Path], Path], run: Run
) -> None:
    tree = copy_tree(tmp_path / "tree")
    context = tmp_path / "context"
    for name in allowed_into_the_image():
        target = context / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if (tree / name).is_dir():
            shutil.copytree(tree / name, target)
        else:
            shutil.copy2(tree / name, target)
    prefix = tmp_path / "prefix"
    # The image has no virtual environment around it, so neither has this.
    bare = os.pathsep.join(
        part for part in os.environ["PATH"].split(os.pathsep) if not (Path(part) / "activate").exists()
    )
    run(["sh", "docker/install.sh", prefix], cwd=context, PATH=bare)
    listing = run([prefix / "bin" / "kuglice", "scenes"], cwd=tmp_path)
    assert "arena" in listing
    run(
        [prefix / "bin" / "python", "-I", "-c", "import av, PIL, kuglice_client, kuglice_server"],
        cwd=tmp_path,
    )


def test_the_image_runs_those_steps_and_not_as_root() -> None:
    lines = (ROOT / "docker" / "Dockerfile").read_text().splitlines()
    assert "RUN sh docker/install.sh /opt/kuglice" in lines
    assert "COPY . ." in lines
    users = [line.split()[1] for line in lines if line.startswith("USER ")]
    assert users
    assert users[-1] not in ("root", "0")


def test_every_service_of_ours_says_a_command_that_the_command_line_understands() -> None:
    group = typer.main.get_command(build())
    ours = {name: service for name, service in services().items() if service["image"] == "kuglice"}
    assert sorted(ours) == ["client-1", "client-2", "server"]
    players = []
    for service in ours.values():
        name, *arguments = service["command"]
        # Parsed and checked to the last option, but not run.
        command = group.get_command(group.make_context("kuglice", [name]), name)
        given = command.make_context(name, list(arguments)).params
        assert list(given["connect"]) == ["tcp/router:7447"]
        if name == "client":
            players.append((given["name"], given["bot"]))
    names, bots = zip(*players, strict=True)
    assert len(set(names)) == len(players)
    assert set(bots) <= set(BOTS)


def test_router_and_sessions_are_of_one_version() -> None:
    constraints = (ROOT / ".ci" / "python-constraints.txt").read_text().splitlines()
    (session,) = (line.split("==")[1] for line in constraints if line.startswith("eclipse-zenoh=="))
    assert services()["router"]["image"] == f"eclipse/zenoh:{session}"
