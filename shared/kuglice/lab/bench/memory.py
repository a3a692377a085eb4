"""Bytes per ball of a million balls at the peak, all scratch memory counted: what a fresh process grows by."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping

from kuglice.lab.bench.case import Measure, Samples
from kuglice.lab.running import CannotRunError

__all__ = ["CASES"]

BALLS = 1_000_000
TICKS = 70
"""Enough for the balls to be put in spatial order twice, which takes memory of its own."""

PROGRAM = f"""
import ctypes, gc, sys
from pathlib import Path
from kuglice.model import Model
from kuglice.scenes import gas
from kuglice.world import World

def kilobytes(name):
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name))

scene = gas(n={BALLS})
scene.balls
gc.collect()
ctypes.CDLL(None).malloc_trim(0)
model = Model(integrator="verlet", contacts=sys.argv[1])
World(gas(n=10), model).run(1)
Path("/proc/self/clear_refs").write_text("5")
before = kilobytes("VmRSS:")
world = World(scene, model)
world.run({TICKS})
print(1024 * (kilobytes("VmHWM:") - before) / {BALLS})
"""
"""The peak of what is resident is set back (5: see proc(5)) when everything but the world is there; what the layout of
the scene has freed is given back before, so that the world cannot live in it unseen."""
ENVIRONMENT = {"MALLOC_MMAP_THRESHOLD_": "131072"}
"""Of glibc: large buffers always come from the system and go back there."""


def _peaks(repeats: int) -> Mapping[str, Samples]:
    return {
        contacts: Samples(tuple(_peak(contacts) for _ in range(min(repeats, 2))), "bytes per ball")
        for contacts in ("overlap", "event")
    }


def _peak(contacts: str) -> float:
    command = [sys.executable, "-c", PROGRAM, contacts]
    done = subprocess.run(command, env=os.environ | ENVIRONMENT, capture_output=True, text=True, check=False)
    if done.returncode:
        raise CannotRunError(f"the process that was to be measured failed: {done.stderr.strip()}")
    return float(done.stdout)


CASES: dict[str, Measure] = {f"memory at the peak, {BALLS:,}": _peaks}
