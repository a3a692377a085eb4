"""Every way of installing gives the same Kuglice: from a directory, editable, from a wheel, from an sdist."""

import json
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

import kuglice as kg

Run = Callable[..., str]

pytestmark = pytest.mark.timeout(900)

STEP_A_WORLD = """
import json, kuglice, kuglice._core, kuglice_client, kuglice_server
world = kuglice.World(kuglice.scenes.find("gas:n=60"))
world.run(120)
print(json.dumps({
    "files": [kuglice.__file__, kuglice_server.__file__, kuglice_client.__file__, kuglice._core.__file__],
    "hash": world.state_hash,
}))
"""


@dataclass(frozen=True)
class Installation:
    """How it was made, its python, the tree that it was made from, and what files it may run from."""

    way: str
    python: Path
    tree: Path
    home: Path


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory, copy_tree: Callable[[Path], Path]) -> Path:
    return copy_tree(tmp_path_factory.mktemp("tree"))


@pytest.fixture(scope="module")
def distributions(tree: Path, run: Run, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """An sdist, and the wheel that is built from it (not from the tree)."""
    out = tmp_path_factory.mktemp("dist")
    run([sys.executable, "-m", "build", "--outdir", out, tree], cwd=out)
    (sdist,) = out.glob("*.tar.gz")
    (wheel,) = out.glob("*.whl")
    return {"sdist": sdist, "wheel": wheel}


@pytest.fixture(scope="module", params=["directory", "editable", "wheel", "sdist"])
def installation(
    request: pytest.FixtureRequest,
    tree: Path,
    run: Run,
    new_environment: Callable[[Path], Path],
    tmp_path_factory: pytest.TempPathFactory,
) -> Installation:
    way: str = request.param
    prefix = tmp_path_factory.mktemp(way)
    python = new_environment(prefix)
    if way in ("wheel", "sdist"):
        source: list[str | Path] = [request.getfixturevalue("distributions")[way]]
    else:
        source = ["--editable", tree] if way == "editable" else [tree]
    run([python, "-m", "pip", "install", "--quiet", "--no-deps", "--ignore-installed", *source], cwd=prefix)
    return Installation(way, python, tree, tree if way == "editable" else prefix)


def test_all_rooms_come_from_the_installation_and_step_to_the_same_bits(
    installation: Installation, run: Run
) -> None:
    # Isolated mode: neither the directory nor PYTHONPATH of this test run lends it a module.
    answer = json.loads(run([installation.python, "-I", "-c", STEP_A_WORLD], cwd=installation.python.parent))
    for file in answer["files"]:
        assert Path(file).is_relative_to(installation.home), f"{file} is not in {installation.home}"
    here = subprocess.run(
        [sys.executable, "-c", STEP_A_WORLD], capture_output=True, text=True, check=True
    ).stdout
    assert answer["hash"] == json.loads(here)["hash"]


@pytest.mark.parametrize("command", ["scenes", "plan", "replay", "server", "client", "render", "demo"])
def test_the_console_script_knows_the_commands_of_every_room(
    installation: Installation, run: Run, command: str
) -> None:
    script = installation.python.with_name("kuglice")
    assert f"kuglice {command}" in run([script, command, "--help"], cwd=installation.python.parent)


def test_the_console_script_finds_the_built_in_scenes(installation: Installation, run: Run) -> None:
    script = installation.python.with_name("kuglice")
    table = json.loads(run([script, "scenes", "--json"], cwd=installation.python.parent))
    assert {row["scene"] for row in table} == set(kg.scenes.TABLE)


def test_types_are_installed(installation: Installation, run: Run) -> None:
    where = "import kuglice; from pathlib import Path; print(Path(kuglice.__file__).parent)"
    package = Path(run([installation.python, "-I", "-c", where], cwd=installation.python.parent).strip())
    assert (package / "py.typed").is_file()
    assert (package / "_core.pyi").is_file()


def test_nothing_is_ever_a_debug_build(installation: Installation, cargo_target: Path) -> None:
    assert (cargo_target / "release").is_dir()
    assert not (cargo_target / "debug").exists(), f"{installation.way} built without optimisation"


def test_the_wheel_serves_every_python_and_holds_only_what_runs(distributions: dict[str, Path]) -> None:
    assert "-cp311-abi3-" in distributions["wheel"].name
    names = zipfile.ZipFile(distributions["wheel"]).namelist()
    rooms = {name.split("/")[0] for name in names if ".dist-info/" not in name}
    assert rooms == {"kuglice", "kuglice_server", "kuglice_client"}
    sources = [name for name in names if name.endswith((".rs", "Cargo.toml"))]
    assert not [name for name in sources if not name.startswith("kuglice/lab/peers/rapier/")]
    assert any(name.endswith("licenses/LICENSE") for name in names)


def test_the_sdist_holds_the_sources_and_nothing_built(distributions: dict[str, Path], tree: Path) -> None:
    with tarfile.open(distributions["sdist"]) as archive:
        names = {name.split("/", 1)[1] for name in archive.getnames() if "/" in name}
    sources = {str(path.relative_to(tree)) for path in tree.glob("shared/core/**/*.rs")}
    python = {
        str(path.relative_to(tree))
        for room in ("shared", "server", "client")
        for path in tree.glob(f"{room}/**/*.py")
    }
    assert sources | python <= names
    assert not [name for name in names if name.endswith(".so") or "/target/" in name]
