"""The measurements: gas at packing 0.30 under `overlap`, one thing varied at a time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial

from kuglice import _core
from kuglice.lab.jobs import Effort, Job
from kuglice.lab.rows import Row, Rows, Value
from kuglice.lab.stopwatch import Work, race
from kuglice.layout import RandomGroup
from kuglice.model import Model
from kuglice.scene import Scene
from kuglice.scenes import gas
from kuglice.world import World

__all__ = ["jobs"]

COUNTS = (10, 30, 100, 300, 1_000, 3_000, 10_000, 20_000, 30_000, 100_000, 1_000_000)
QUICK_COUNTS = (10, 100, 1_000, 10_000)
MOST_BRUTE = 20_000
MOST_CLASSICAL = 100_000
"""The classical quadtree is far behind by then."""
RATIOS = (1.0, 3.0, 10.0, 30.0, 100.0)
PACKINGS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8)
LEVELS = (2, 3, 4, 5, 6, 7, 8, 9)
MANY = 10_000
BALL_STEPS = 200_000
"""Of one repeat: enough for the clock, few enough for brute force."""
PAIR_TESTS = 1e8
"""At most, of one repeat of brute force."""
SPREAD_BALLS = 3_000


def jobs(effort: Effort, left_out: list[str]) -> list[Job]:
    """One per point of the four panels."""
    left_out.append(f"cost_growth: brute above {MOST_BRUTE:,} balls: a tick would take more than a second")
    left_out.append(f"cost_growth: quadtree above {MOST_CLASSICAL:,} balls")
    repeats = effort.repeats
    many = MANY // 10 if effort.quick else MANY
    counts = QUICK_COUNTS if effort.quick else COUNTS
    found = [Job(f"cost of {n:,} balls", partial(_by_count, n, repeats)) for n in counts]
    found += [
        Job(f"cost with a tree of {level} levels", partial(_by_level, level, many, repeats))
        for level in (LEVELS[::3] if effort.quick else LEVELS)
    ]
    found += [
        Job(f"cost with radii 1:{ratio:g}", partial(_by_ratio, ratio, repeats, effort.quick))
        for ratio in (RATIOS[:3] if effort.quick else RATIOS)
    ]
    found += [
        Job(f"cost at packing {packing:g}", partial(_by_packing, packing, many, repeats))
        for packing in (PACKINGS[1::3] if effort.quick else PACKINGS)
    ]
    return found


def _by_count(count: int, repeats: int) -> Rows:
    able = [
        name
        for name in _core.BROADPHASES
        if count <= {"brute": MOST_BRUTE, "quadtree": MOST_CLASSICAL}.get(name, count)
    ]
    return _costs("count", count, gas(n=count), {name: Model(broadphase=name) for name in able}, repeats)


def _by_level(level: int, count: int, repeats: int) -> Rows:
    scene = gas(n=count)
    width, height = scene.box[2] - scene.box[0], scene.box[3] - scene.box[1]
    model = Model(broadphase="quadtree", smallest_node=1.001 * max(width, height) / 2**level)
    return _costs("levels", level, scene, {"quadtree": model}, repeats)


def _by_ratio(ratio: float, repeats: int, quick: bool) -> Rows:
    """Radii spread evenly from 1 to `ratio`, at the packing of the gas."""
    mean_square = (ratio**3 - 1.0) / (3.0 * (ratio - 1.0)) if ratio > 1.0 else 1.0
    count = SPREAD_BALLS // (10 if quick else 1)
    height = math.sqrt(count * math.pi * mean_square / 0.3 * 9.0 / 16.0)
    scene = Scene(
        box=(0.0, 0.0, height * 16.0 / 9.0, height),
        groups=(RandomGroup(count=count, radius=(1.0, max(ratio, 1.0 + 1e-9)), speed=10.0),),
    )
    return _costs(
        "ratio", ratio, scene, {name: Model(broadphase=name) for name in _core.BROADPHASES}, repeats
    )


def _by_packing(packing: float, count: int, repeats: int) -> Rows:
    models = {name: Model(broadphase=name) for name in _core.BROADPHASES if name != "brute"}
    return _costs("packing", packing, gas(n=count, packing=packing), models, repeats)


def _costs(varied: str, value: float, scene: Scene, models: Mapping[str, Model], repeats: int) -> list[Row]:
    count = len(scene.balls)
    contenders, ticks = {}, {}
    for name, model in models.items():
        most = BALL_STEPS / count
        if name == "brute" or varied == "levels":
            # Of few levels, the classical quadtree tests nearly every pair too.
            most = min(most, PAIR_TESTS / (count * count))
        ticks[name] = max(1, round(most))
        world = World(scene, model)
        world.run(1)

        def prepare(world: World = world, ticks: int = ticks[name]) -> Work:
            return lambda: world.run(ticks)

        contenders[name] = prepare
    timings = race(contenders, repeats)
    rows: list[Row] = []
    for name, timing in timings.items():
        unit = 1e9 / (ticks[name] * count)
        row: dict[str, Value] = {
            "varied": varied,
            "value": value,
            "balls": count,
            "broadphase": name,
            "cost": timing.minimum * unit,
            "cost_median": timing.median * unit,
            "repeats": timing.repeats,
            "seeds": "1",
        }
        rows.append(row)
    return rows
