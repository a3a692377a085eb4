"""The measurements of one work-precision diagram."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from kuglice.errors import StepError
from kuglice.lab.energy import conserved
from kuglice.lab.jobs import Effort, Job
from kuglice.lab.methods import Method, distinct
from kuglice.lab.peers import PEERS
from kuglice.lab.reference import reference, seconds_until
from kuglice.lab.rows import Row, Rows, Value
from kuglice.lab.running import CannotRunError, Make, Running, making
from kuglice.lab.stopwatch import Timing, Work, race
from kuglice.lab.work_precision.errors import long_run, position_error, seen
from kuglice.lab.work_precision.scenes import Subject
from kuglice.scene import Scene

__all__ = ["RATES", "jobs"]

RATES = (30, 60, 120, 240, 480, 960)
QUICK_RATES = (30, 120, 480)
COLLISIONS = 1.0
"""Per ball, until positions are compared: long before rounding matters, in any scene."""
GRAIN = 1 / 30
"""Windows are whole numbers of the longest tick."""
TIMED_SECONDS = 2.0
SEEN_FINER = 4
"""Parts of a tick in which collisions are counted: each is from the right state, so few will do."""
RAN_PEERS = ("pymunk", "pymunk, 30 iterations", "rapier2d")
"""The others are `overlap` in other clothes."""


def jobs(name: str, subject: Subject, effort: Effort, left_out: list[str]) -> list[Job]:
    """One per length of tick; what cannot run is put on the list with its reason."""
    scene = subject.make(effort.seeds[0])
    methods, reason = distinct(scene)
    if reason:
        left_out.append(f"{name}: {reason}")
    makes: dict[str, Make] = {str(method): making(method.model()) for method in methods}
    for peer in RAN_PEERS if effort.peers else ():
        try:
            PEERS[peer](scene)
        except CannotRunError as error:
            left_out.append(f"{name}: without {peer}: {error}")
            continue
        makes[peer] = PEERS[peer]
    rates = QUICK_RATES if effort.quick else RATES
    by_name = {str(method): method for method in methods}
    return [
        Job(f"{name} at {rate} ticks/s", partial(_measure, subject, makes, by_name, rate, max(rates), effort))
        for rate in rates
    ]


def _measure(  # noqa: PLR0917 - a partial fills them
    subject: Subject,
    makes: Mapping[str, Make],
    methods: Mapping[str, Method],
    rate: int,
    highest_rate: int,
    effort: Effort,
) -> Rows:
    seeds = effort.seeds if subject.seeded and not effort.quick else effort.seeds[:1]
    scenes = [_at(subject, seed, rate) for seed in seeds]
    costs = _costs(scenes[0], makes, effort.repeats)
    positions = _positions(subject, seeds, rate, highest_rate, makes)
    shares = _missed(scenes, methods, subject.window)
    unit = 1e9 / (TIMED_SECONDS * len(scenes[0].balls))
    rows: list[Row] = []
    for name, make in makes.items():
        row: dict[str, Value] = {"method": name, "tick_rate": rate}
        if name in methods:
            row |= {"integrator": methods[name].integrator, "contacts": methods[name].contacts}
        if name in costs:
            row |= {"cost": costs[name].minimum * unit, "cost_median": costs[name].median * unit}
        row |= positions.get(name, {})
        row |= _long(scenes[0], make, subject.seconds / (6.0 if effort.quick else 1.0))
        row |= shares.get(name, {})
        row |= {"repeats": effort.repeats, "seeds": " ".join(map(str, seeds))}
        rows.append(row)
    return rows


def _at(subject: Subject, seed: int, rate: int) -> Scene:
    return subject.make(seed).model_copy(update={"tick_rate": float(rate)})


def _costs(scene: Scene, makes: Mapping[str, Make], repeats: int) -> dict[str, Timing]:
    ticks = round(TIMED_SECONDS * scene.tick_rate)
    able = {}
    for name, make in makes.items():
        try:
            make(scene).run(ticks)
        except StepError:
            continue

        def prepare(make: Make = make) -> Work:
            run = make(scene).run
            return lambda: run(ticks)

        able[name] = prepare
    return race(able, repeats)


def _positions(
    subject: Subject, seeds: Sequence[int], rate: int, highest_rate: int, makes: Mapping[str, Make]
) -> dict[str, dict[str, Value]]:
    """Root mean square over seeds."""
    squares: dict[str, list[float]] = {name: [] for name in makes}
    for seed in seeds:
        window, right = _right(subject, seed, highest_rate)
        scene = _at(subject, seed, rate)
        for name, make in makes.items():
            running = make(scene)
            if _ran(running, round(window * rate)):
                error = position_error(running.position, right, scene.balls.radius)
                squares[name].append(error * error)
    return {
        name: {"position_error": float(np.sqrt(np.mean(each)))}
        for name, each in squares.items()
        if len(each) == len(seeds)
    }


@cache
def _right(subject: Subject, seed: int, highest_rate: int) -> tuple[float, NDArray[np.float64]]:
    """The window of a scene, and where its balls are at the end of it."""
    scene = _at(subject, seed, highest_rate)
    window, collisions = seconds_until(scene, COLLISIONS, subject.window, GRAIN)
    world = reference(scene, collisions=collisions > 0)
    world.run(round(window * highest_rate))
    return window, world.position


def _ran(running: Running, ticks: int) -> bool:
    try:
        running.run(ticks)
    except StepError:
        return False
    return True


def _long(scene: Scene, make: Make, seconds: float) -> dict[str, Value]:
    try:
        drift, depth = long_run(scene, make(scene), seconds)
    except StepError as error:
        return {"note": str(error)}
    found: dict[str, Value] = {"deepest_overlap": depth}
    return found | {"energy_drift": drift} if conserved(scene) else found


def _missed(
    scenes: list[Scene], methods: Mapping[str, Method], seconds: float
) -> dict[str, dict[str, Value]]:
    models = {name: method.model() for name, method in methods.items()}
    there, counts = 0, dict.fromkeys(models, 0)
    for scene in scenes:
        right = reference(scene, finer=SEEN_FINER)
        found, all_of_them = seen(scene, models, right, round(min(seconds, 1.0) * scene.tick_rate))
        there += all_of_them
        counts = {name: counts[name] + found[name] for name in counts}
    if not there:
        return {}
    return {
        name: {"missed": max(0.0, 1.0 - count / there), "collisions": there} for name, count in counts.items()
    }
