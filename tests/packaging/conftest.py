"""A clean copy of the tree, and virtual environments that Kuglice is installed into."""

import os
import re
import shutil
import subprocess
import sys
import venv
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NEVER_COPIED = shutil.ignore_patterns(
    ".git", ".venv", "target", "build", "dist", "out", "*.so", "*.egg-info", "__pycache__", ".*_cache"
)

Run = Callable[..., str]


def tracked_files() -> list[Path]:
    """What a clone of the working tree would hold: new files too, ignored ones not."""
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=True,
        text=True,
    )
    return [Path(name) for name in listing.stdout.split("\0") if name and (ROOT / name).is_file()]


@pytest.fixture(scope="session")
def copy_tree() -> Callable[[Path], Path]:
    """Copy what belongs to the project to a place where nothing was ever built."""

    def copy(target: Path) -> Path:
        if (ROOT / ".git").exists():
            for name in tracked_files():
                (target / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, target / name)
        else:
            shutil.copytree(ROOT, target, ignore=NEVER_COPIED, dirs_exist_ok=True)
        lock = ROOT / "shared" / "core" / "Cargo.lock"
        if lock.exists():
            shutil.copy2(lock, target / "shared" / "core" / "Cargo.lock")
        return target

    return copy


@pytest.fixture(scope="session")
def cargo_target() -> Path:
    """One target directory for all installations: the crates from outside are compiled once."""
    return ROOT / "shared" / "core" / "target" / "packaging"


@pytest.fixture(scope="session")
def run(cargo_target: Path) -> Run:
    """Run a command outside the tree; its output is the value, and the message when it fails."""
    # One job: the tests of other rooms run on the same machine meanwhile.
    build = {"CARGO_TARGET_DIR": str(cargo_target), "CARGO_BUILD_JOBS": "1"}

    def run_command(command: Sequence[str | Path], cwd: Path, **environment: str) -> str:
        inherited = {name: text for name, text in os.environ.items() if not name.startswith("PYTHON")}
        done = subprocess.run(
            [str(word) for word in command],
            cwd=cwd,
            env=inherited | build | environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        # Addresses of package indexes are nobody's business in a log.
        output = re.sub(r"\w+://[^\s'\",)]+", "<address>", done.stdout)
        assert done.returncode == 0, f"{command} ended with {done.returncode}:\n{output[-4000:]}"
        return output

    return run_command


@pytest.fixture(scope="session")
def new_environment() -> Callable[[Path], Path]:
    """A virtual environment that sees this one's dependencies but not its Kuglice; returns its python."""

    def create(prefix: Path) -> Path:
        venv.create(prefix, with_pip=True, symlinks=True)
        python = prefix / "bin" / "python"
        site = prefix / "lib" / f"python{sys.version_info[0]}.{sys.version_info[1]}" / "site-packages"
        # A path in a .pth file is searched, but .pth files found there (an editable Kuglice) are not obeyed.
        dependencies = Path(pytest.__file__).parents[1]
        (site / "dependencies.pth").write_text(f"{dependencies}\n")
        return python

    return create
