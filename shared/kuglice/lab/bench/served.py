"""What a server of ten thousand balls at 60 Hz takes of one core, publishing to a listener included."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

from kuglice.lab.bench.case import Measure, Samples
from kuglice.lab.capacity.crowd import Crowd
from kuglice.lab.capacity.processor import processor_seconds
from kuglice.lab.running import CannotRunError
from kuglice.processes import CommandProcess, free_port
from kuglice.scene import ModelPins, Scene
from kuglice.scenes import gas

__all__ = ["CASES"]

BALLS = 10_000
WORLD = "served"
START_SECONDS = 30.0
SECONDS = 3.0
KEPT_PACE = 0.95
"""Of the scene's ticks per second, at least: a server that falls behind would seem to cost less."""


def _shares(repeats: int) -> Mapping[str, Samples]:
    return {
        contacts: Samples(_share(contacts, min(repeats, 3)), "percent of one core")
        for contacts in ("overlap", "event")
    }


def _share(contacts: str, repeats: int) -> tuple[float, ...]:
    scene = gas(n=BALLS).model_copy(update={"model": ModelPins(integrator="verlet", contacts=contacts)})
    endpoint = f"tcp/127.0.0.1:{free_port()}"
    with tempfile.TemporaryDirectory() as folder, Crowd(WORLD) as crowd:
        scene.save(file := Path(folder) / "scene.toml")
        server = CommandProcess(
            Path(folder), "server", ["server", file, "--world", WORLD, "--listen", endpoint]
        )
        try:
            server.wait_for_words("balls on", START_SECONDS)
            crowd.grow(1, endpoint)
            time.sleep(SECONDS / 2)
            return tuple(_measured(scene, server, crowd) for _ in range(repeats))
        finally:
            server.end()


def _measured(scene: Scene, server: CommandProcess, crowd: Crowd) -> float:
    crowd.heard()
    spent, began = processor_seconds(server.pid), time.monotonic()
    if not spent:
        raise CannotRunError("processor time of other processes cannot be read here")
    time.sleep(SECONDS)
    spent, seconds = processor_seconds(server.pid) - spent, time.monotonic() - began
    rate = crowd.heard().messages / seconds
    if rate < KEPT_PACE * scene.tick_rate:
        raise CannotRunError(f"{rate:.1f} ticks per second were heard of {scene.tick_rate:g}: it fell behind")
    return 100.0 * spent / seconds


CASES: dict[str, Measure] = {f"server, {BALLS:,} balls at 60 Hz": _shares}
