"""The step, built without Python in three ways; each runs a recording again and prints its hashes."""

import os
import platform
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
MANIFEST = ROOT / "shared" / "core" / "Cargo.toml"
TARGET = ROOT / "shared" / "core" / "target"
ARM = "aarch64-unknown-linux-gnu"
ARM_LIBRARIES = "/usr/aarch64-linux-gnu"
CI_INSTALLS_IT = "(.ci/run installs it on Debian)"

Rerun = Callable[[bytes], list[int]]


def build(cargo: str, *options: str, **environment: str) -> None:
    command = [cargo, "build", "--quiet", "--manifest-path", str(MANIFEST), "--package", "kuglice-step"]
    done = subprocess.run(
        [*command, "--example", "rerun", *options],
        env=os.environ | environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout


def runs(path: Path, *command: str) -> Rerun:
    def rerun(recording: bytes) -> list[int]:
        path.write_bytes(recording)
        done = subprocess.run([*command, str(path)], capture_output=True, text=True, check=False, timeout=240)
        assert done.returncode == 0, done.stderr
        return [int(line.split()[1], 16) for line in done.stdout.splitlines()]

    return rerun


def arm_toolchain() -> tuple[str, str]:
    """(cargo, rustc) with a standard library for AArch64: a distribution's, or the one in use here."""
    asked = {"/usr/bin/cargo": "/usr/bin/rustc", "cargo": "rustc"}
    for cargo, rustc in asked.items():
        if not (shutil.which(cargo) and shutil.which(rustc)):
            continue
        question = [rustc, "--print", "target-libdir", "--target", ARM]
        answer = subprocess.run(question, capture_output=True, text=True, check=False).stdout.strip()
        if answer and list(Path(answer).glob("libstd-*.rlib")):
            return cargo, rustc
    pytest.skip(f"no Rust standard library for {ARM}: install libstd-rust-web-dev:arm64 {CI_INSTALLS_IT}")


@pytest.fixture(scope="session")
def debug_build(tmp_path_factory: pytest.TempPathFactory) -> Rerun:
    """Without optimisation, with overflow checks."""
    build("cargo")
    return runs(tmp_path_factory.mktemp("debug") / "run", str(TARGET / "debug" / "examples" / "rerun"))


@pytest.fixture(scope="session")
def release_build(tmp_path_factory: pytest.TempPathFactory) -> Rerun:
    """Optimised, this processor."""
    build("cargo", "--release")
    return runs(tmp_path_factory.mktemp("release") / "run", str(TARGET / "release" / "examples" / "rerun"))


@pytest.fixture(scope="session")
def arm_build(tmp_path_factory: pytest.TempPathFactory) -> Rerun:
    """Optimised for another processor, run by an emulator."""
    if platform.system() != "Linux" or platform.machine() == "aarch64":
        pytest.skip(
            f"{platform.system()} on {platform.machine()}: AArch64 is emulated on Linux on other processors"
        )
    for tool, package in [("qemu-aarch64", "qemu-user"), ("aarch64-linux-gnu-gcc", "gcc-aarch64-linux-gnu")]:
        if shutil.which(tool) is None:
            pytest.skip(f"no {tool}: install {package} {CI_INSTALLS_IT}")
    if not Path(ARM_LIBRARIES).is_dir():
        pytest.skip(f"no {ARM_LIBRARIES}: install libc6-dev-arm64-cross {CI_INSTALLS_IT}")
    cargo, rustc = arm_toolchain()
    target = TARGET / "emulated"
    linker = f"CARGO_TARGET_{ARM.upper().replace('-', '_')}_LINKER"
    build(
        cargo,
        "--release",
        "--target",
        ARM,
        RUSTC=rustc,
        CARGO_TARGET_DIR=str(target),
        **{linker: "aarch64-linux-gnu-gcc"},
    )
    binary = target / ARM / "release" / "examples" / "rerun"
    file = tmp_path_factory.mktemp("arm") / "run"
    return runs(file, "qemu-aarch64", "-L", ARM_LIBRARIES, str(binary))
