#!/usr/bin/env python3
"""Gives every crate the version named in .ci/cargo-versions.txt.

Cargo.lock names the host of a registry, so it is not committed; the versions are, and this puts them back.
`.ci/pin_cargo.py --write` writes the list anew from the Cargo.lock that is there.
"""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
VERSIONS = HERE / "cargo-versions.txt"
MANIFEST = HERE.parent / "shared" / "core" / "Cargo.toml"
LOCK = MANIFEST.with_name("Cargo.lock")


def cargo(*arguments: str) -> bool:
    """Run cargo on the workspace; its complaints are shown only by the last word of main()."""
    command = ["cargo", *arguments, "--quiet", "--manifest-path", str(MANIFEST)]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def locked() -> set[tuple[str, str]]:
    """(name, version) of every crate that comes from outside, as Cargo.lock has it."""
    packages = tomllib.loads(LOCK.read_text())["package"]
    return {(package["name"], package["version"]) for package in packages if "source" in package}


def compatible(version: str) -> str:
    """The part of a version that cargo never changes by itself: 1.2.3 -> 1, 0.2.3 -> 0.2, 0.0.3 -> 0.0.3."""
    parts = version.split(".")
    leading = next((index for index, part in enumerate(parts) if part != "0"), len(parts) - 1)
    return ".".join(parts[: leading + 1])


def pin(wanted: set[tuple[str, str]]) -> None:
    """One pass: whatever differs from `wanted` is moved there, where the other crates already allow it."""
    targets = {(name, compatible(version)): version for name, version in wanted}
    for name, version in sorted(locked() - wanted):
        target = targets.get((name, compatible(version)))
        if target is not None:
            cargo("update", "--precise", target, f"{name}@{version}")


def main() -> int:
    """Pin, and fail when the lock that comes out is not the one that was tested."""
    if not LOCK.exists() and not cargo("generate-lockfile"):
        print("pin-cargo: cargo could not resolve the crates: see `cargo generate-lockfile`", file=sys.stderr)
        return 1
    if "--write" in sys.argv:
        VERSIONS.write_text("".join(f"{name} {version}\n" for name, version in sorted(locked())))
        return 0
    wanted = {(name, version) for name, version in map(str.split, VERSIONS.read_text().splitlines())}
    before = None
    while (now := locked()) != wanted and now != before:
        # A crate can be moved only after those that demand more of it, so passes go on while they help.
        before = now
        pin(wanted)
    if locked() != wanted:
        off = ", ".join(f"{name} {version}" for name, version in sorted(locked() ^ wanted))
        print(f"pin-cargo: Cargo.lock differs from .ci/cargo-versions.txt in {off};", file=sys.stderr)
        print("pin-cargo: after a change of dependencies run .ci/pin_cargo.py --write", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
