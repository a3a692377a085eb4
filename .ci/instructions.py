#!/usr/bin/env python3
"""Counts the instructions of fixed runs under callgrind and compares them with committed figures: within 3 % or failed.

`make instructions` compares, `make instructions RENEW=1` writes .ci/instructions.csv anew, which a change that makes
the step faster or slower on purpose does. Counts repeat to the instruction on one machine; they depend on the compiler,
so with another one than that of the figures differences are told and nothing fails.

Valgrind runs the same code on every x86-64 processor but where a library asks what the processor can do. The C library
does, for memcpy: it is told to do without the instructions that differ. The state hash does, for AVX2: its figure
is that of a processor which has it.
"""

from __future__ import annotations

import csv
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FIGURES = ROOT / ".ci" / "instructions.csv"
MANIFEST = ROOT / "shared" / "core" / "Cargo.toml"
PROGRAM = ROOT / "shared" / "core" / "target" / "release" / "examples" / "instructions"
TOLERANCE = 0.03
PLAIN = "glibc.cpu.hwcaps=-AVX2,-AVX512F,-AVX512VL,-ERMS,-FSRM,-AVX_Fast_Unaligned_Load,-AVX2_Usable"


def said(*command: str | Path) -> str:
    """What a command prints."""
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def count(case: str) -> int:
    """Instructions of one case."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [
                "valgrind",
                "--tool=callgrind",
                "--collect-atstart=no",
                "--toggle-collect=*instructions*counted*",
                f"--callgrind-out-file={folder}/out",
                PROGRAM,
                case,
            ],
            check=False,
            capture_output=True,
            text=True,
            env=os.environ | {"GLIBC_TUNABLES": PLAIN},
        )
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode or not found or not int(found[1]):
        sys.exit(f"instructions: {case}: callgrind counted nothing:\n{done.stderr}")
    return int(found[1])


def read() -> tuple[str, dict[str, int]]:
    """The compiler of the committed figures, and these."""
    lines = FIGURES.read_text(encoding="utf-8").splitlines()
    compiler = next(line.removeprefix("# ") for line in lines if line.startswith("# rustc"))
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return compiler, {row["case"]: int(row["instructions"]) for row in rows}


def write(compiler: str, counts: dict[str, int]) -> None:
    """Make these the figures."""
    with FIGURES.open("w", encoding="utf-8", newline="") as file:
        file.write(f"# {compiler}\n# {platform.machine()}, {said('valgrind', '--version')}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "instructions"])
        writer.writerows(counts.items())
    print(f"instructions: wrote {FIGURES.relative_to(ROOT)}")


def compare(compiler: str, counts: dict[str, int]) -> int:
    """Name what is off; the exit code."""
    written_by, expected = read()
    wrong = [f"{case}: is not among the figures" for case in counts.keys() - expected.keys()]
    wrong += [f"{case}: is among the figures and is gone" for case in expected.keys() - counts.keys()]
    for case in counts.keys() & expected.keys():
        change = counts[case] / expected[case] - 1.0
        if abs(change) > TOLERANCE:
            wrong.append(f"{case}: {counts[case]:,}, {change:+.1%} from {expected[case]:,}")
    for line in sorted(wrong):
        print(f"instructions: {line}", file=sys.stderr)
    if wrong and written_by != compiler:
        print(
            f"instructions: NOT JUDGED: the figures are of {written_by}, this is {compiler}", file=sys.stderr
        )
        return 0
    if wrong:
        print("instructions: if that is meant, `make instructions RENEW=1` and say why", file=sys.stderr)
        return 1
    print(f"instructions: {len(counts)} counts are within {TOLERANCE:.0%} of the figures")
    return 0


def main() -> int:
    """Build, count, and compare or write."""
    if shutil.which("valgrind") is None or platform.machine() != "x86_64":
        print("instructions: SKIPPED: they are counted by valgrind, on x86-64", file=sys.stderr)
        return 0
    subprocess.run(
        [
            "cargo",
            "build",
            "--release",
            "--quiet",
            "--manifest-path",
            MANIFEST,
            "-p",
            "kuglice-step",
            "--example",
            "instructions",
        ],
        check=True,
    )
    counts = {case: count(case) for case in said(PROGRAM).splitlines()}
    compiler = said("rustc", "--version")
    if sys.argv[1:] == ["--renew"]:
        write(compiler, counts)
        return 0
    return compare(compiler, counts)


if __name__ == "__main__":
    sys.exit(main())
