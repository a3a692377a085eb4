"""World: a scene that runs. A thin front of the compiled step that remembers its scene and model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kuglice import _core
from kuglice.ball_states import BallStates, ids
from kuglice.errors import LimitError, MissingExtraError, ModelError, SceneError, SnapshotError
from kuglice.inputs import Input, pack
from kuglice.model import Model
from kuglice.planner import plan
from kuglice.scene import Scene
from kuglice.wording import of_many

__all__ = ["World"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]
MOST_TICKS = 2**63
MOST_PAIRS = 2**64
"""The core counts both in 64 bits."""


class World:
    """State and step of a scene. Without a model, `plan(scene)` chooses one.

    `threads` share the work of a step (1 to 256): they show in nothing but its time, and clones share them.
    Raises LimitError for another number.

    Arrays that properties return are copies in id order, safe to keep; `view()` lends the memory itself.
    Stepping releases the GIL; one world is not to be stepped from two threads at once, nor looked at by one while
    another steps it: that raises RuntimeError.
    """

    __slots__ = ("_core", "_model", "_scene")

    def __init__(self, scene: Scene, model: Model | None = None, *, threads: int = 1) -> None:
        self._scene = scene
        self._model = plan(scene) if model is None else model
        balls = scene.balls
        self._core = _core.World(
            scene.rules(),
            self._model.core(),
            position=balls.position,
            velocity=balls.velocity,
            radius=balls.radius,
            mass=balls.mass,
        )
        self._employ(threads)

    @classmethod
    def with_balls(
        cls, scene: Scene, tick: int, states: BallStates, model: Model | None = None, *, threads: int = 1
    ) -> World:
        """A world of some balls only, as somebody knows them at `tick`; the scene's own balls are not in it.

        It runs the same step as the whole world, so it is a view of that as long as no other ball comes near.
        Raises SceneError, naming the ball, for ids that do not ascend or are given twice, numbers that are
        not finite, and a radius or mass that is not above 0.
        """
        chosen = plan(scene) if model is None else model
        core = _core.World.with_balls(scene.rules(), chosen.core(), tick, **states.arrays())
        made = cls._wrap(scene, chosen, core)
        made._employ(threads)
        return made

    def replace(self, gone: ArrayLike, states: BallStates) -> None:
        """Take the balls `gone` out, and put others in, or right where they are already here; ids ascend.

        For those who are told states instead of inputs: no recording and no tick stream knows of it. Raises
        SceneError as `with_balls`, and LentError while lent; the world then stays as it was.
        """
        self._core.replace(ids("gone", gone), **states.arrays())

    def hold(
        self,
        players: Sequence[tuple[int, int | None]],
        held: Sequence[tuple[int, str, float, float, float]],
    ) -> None:
        """Make these all that `players` and `held` say; raises InputError for what those could not say."""
        self._core.hold(players, held)

    @classmethod
    def restore(cls, scene: Scene, data: bytes, model: Model | None = None, *, threads: int = 1) -> World:
        """The world of a snapshot; it continues bit for bit.

        Raises SnapshotError, also when every ball lies beyond the scene's walls: then it is another scene's.
        """
        chosen = plan(scene) if model is None else model
        made = cls._wrap(scene, chosen, _core.World.restore(scene.rules(), chosen.core(), data))
        made._employ(threads)
        if scene.walls and made.count:
            made._refuse_if_elsewhere()
        return made

    def _refuse_if_elsewhere(self) -> None:
        left, bottom, right, top = self._scene.box
        with self.view() as balls:
            x, y = balls.position[:, 0], balls.position[:, 1]
            if not ((x >= left) & (x <= right) & (y >= bottom) & (y <= top)).any():
                raise SnapshotError(
                    f"snapshot: all {len(x)} balls lie outside the box {list(self._scene.box)}:"
                    " it is of a world of another scene"
                )

    @classmethod
    def _wrap(cls, scene: Scene, model: Model, core: _core.World) -> World:
        made = cls.__new__(cls)
        made._scene, made._model, made._core = scene, model, core
        return made

    def step(
        self, inputs: Iterable[Input] | bytes = (), dt: float | None = None, *, budget: int | None = None
    ) -> None:
        """One tick with inputs in any order, or with records that `pack` made.

        dt, in seconds, replaces 1 / tick_rate for loops of variable step. `budget` bounds the work: how many
        pairs of balls the treatment `event` looks at, because their paths in this tick may cross, about 20 ns
        each; substeps share it equally. Whether a tick is made within it is as much a matter of state, inputs,
        model and dt alone as its bits are; BudgetError means that a larger one may make it. Raises InputError
        for what is no input, LentError while lent, LimitError for a budget that is none, StepError for a tick
        that cannot be made.
        """
        if budget is not None and not 0 <= budget < MOST_PAIRS:
            raise LimitError(f"step: budget = {budget!r}: must be at least 0 and below {MOST_PAIRS}")
        self._core.step(inputs if isinstance(inputs, bytes) else pack(inputs), dt, budget)

    def run(self, ticks: int) -> None:
        """That many ticks without inputs. Raises LimitError for a number below 0, LentError while lent."""
        if not isinstance(ticks, int | np.integer) or not 0 <= ticks < MOST_TICKS:
            raise LimitError(
                f"run: ticks = {ticks!r}: must be a whole number, at least 0 and below {MOST_TICKS}"
            )
        self._core.run(int(ticks))

    def snapshot(self) -> bytes:
        """The state before the next tick's inputs: versioned, checksummed, every bit."""
        return self._core.snapshot()

    def clone(self) -> World:
        """An independent world in the same state."""
        return World._wrap(self._scene, self._model, self._core.clone())

    def copy_from(self, other: World) -> None:
        """Become a copy of another world of the same scene and model, reusing memory.

        Raises LentError while lent, ModelError for a world of another model, SceneError for one of another scene:
        `clone` copies those.
        """
        if self._model is not other._model:
            self._refuse_other_model(other)
        if self._scene is not other._scene:
            self._refuse_other_scene(other)
        self._core.copy_from(other._core)

    def _refuse_other_model(self, other: World) -> None:
        """What is computed must agree; the planner's sentences need not."""
        here, there = (each._model.model_dump(exclude={"reasons"}) for each in (self, other))
        different = [name for name in here if here[name] != there[name]]
        if different:
            name = different[0]
            raise ModelError(
                f"copy_from: {name} of the other world is {there[name]!r}, must be {here[name]!r} as here;"
                " clone() copies a world with its model"
            )

    def _refuse_other_scene(self, other: World) -> None:
        """Worlds of equal scenes are alike, however their balls were described."""
        different = [
            name
            for name in ("box", "walls", "restitution", "tick_rate", "forces", "limits", "players", "balls")
            if getattr(self._scene, name) != getattr(other._scene, name)
        ]
        if different:
            name = different[0]
            here, there = getattr(self._scene, name), getattr(other._scene, name)
            told = "" if name == "balls" else f": is {there!r}, must be {here!r} as here"
            raise SceneError(
                f"copy_from: the scene of the other world differs in its {name}{told};"
                " clone() copies a world with its scene"
            )

    @contextmanager
    def view(self) -> Iterator[_core.Lease]:
        """Lend read-only zero-copy arrays: position, velocity, radius, mass, id; no stepping meanwhile.

        They are in the order of the memory, which keeps neighbours together: `id` says whose numbers they are.
        """
        lease = self._core.lend()
        try:
            yield lease
        finally:
            lease.end()

    @property
    def scene(self) -> Scene:
        """What this world started from."""
        return self._scene

    @property
    def model(self) -> Model:
        """What computes it."""
        return self._model

    def _employ(self, threads: int) -> None:
        if not isinstance(threads, int | np.integer) or not 1 <= threads <= _core.MOST_THREADS:
            raise LimitError(
                f"threads = {threads!r}: must be a whole number, at least 1 and at most {_core.MOST_THREADS}"
            )
        self._core.employ(int(threads))

    @property
    def threads(self) -> int:
        """How many share the work of a step."""
        return self._core.threads

    @property
    def tick(self) -> int:
        """Ticks done since the start of the scene."""
        return self._core.tick

    @property
    def time(self) -> float:
        """Seconds since the start of the scene."""
        return self._core.time

    @property
    def next_id(self) -> int:
        """The id that the next ball will get; ids are never reused."""
        return self._core.next_id

    @property
    def count(self) -> int:
        """Balls now, pegs included."""
        return self._core.count

    def __len__(self) -> int:
        return self._core.count

    @property
    def id(self) -> Ids:
        """(n,) ids, ascending."""
        return self._core.id

    @property
    def position(self) -> Floats:
        """(n, 2)."""
        return self._core.position

    @property
    def velocity(self) -> Floats:
        """(n, 2)."""
        return self._core.velocity

    @property
    def radius(self) -> Floats:
        """(n,)."""
        return self._core.radius

    @property
    def mass(self) -> Floats:
        """(n,), infinite for pegs."""
        return self._core.mass

    @property
    def kinetic_energy(self) -> float:
        """Sum of m v^2 / 2, pegs left out."""
        return self._core.kinetic_energy

    @property
    def potential_energy(self) -> float:
        """Of the forces that have a potential, pegs left out."""
        return self._core.potential_energy

    @property
    def energy(self) -> float:
        """Kinetic and potential."""
        return self._core.kinetic_energy + self._core.potential_energy

    @property
    def momentum(self) -> tuple[float, float]:
        """Sum of m v, pegs left out."""
        return self._core.momentum

    @property
    def collisions(self) -> int:
        """Pairs that exchanged velocity since the start."""
        return self._core.collisions

    @property
    def wall_hits(self) -> int:
        """Reflections at walls since the start."""
        return self._core.wall_hits

    @property
    def inputs_applied(self) -> int:
        """Inputs that took effect since the start."""
        return self._core.inputs_applied

    @property
    def inputs_ignored(self) -> int:
        """Inputs without effect since the start, such as a kick of a ball that was gone."""
        return self._core.inputs_ignored

    @property
    def state_hash(self) -> int:
        """64 bits that stand for the whole state."""
        return self._core.state_hash

    @property
    def players(self) -> list[tuple[int, int | None]]:
        """(client, id of its ball or None), by client."""
        return self._core.players

    @property
    def held(self) -> list[tuple[int, str, float, float, float]]:
        """Inputs being held: (client, "thrust" or "attract", x, y, strength), by client."""
        return self._core.held

    def regions(self, packer: _core.Regions, nodes: Sequence[int]) -> tuple[list[bytes], int]:
        """The balls in each of the packer's `nodes`, packed; and how many balls could not be told."""
        return packer.pack(self._core, nodes)

    def overlapping(self) -> Ids:
        """(k, 2) ids of all pairs that overlap now, sorted."""
        return self._core.overlapping()

    def nodes(self) -> Floats:
        """(k, 4) rectangles (left, bottom, right, top) of occupied nodes of a quadtree over the balls now."""
        return self._core.nodes()

    def __repr__(self) -> str:
        balls = of_many(self.count, "ball")
        return f"World({self._scene.title!r}, tick {self.tick}, {self.count} {balls}, {self._model})"

    def _repr_png_(self) -> bytes | None:
        """None without Pillow: a notebook then shows the text."""
        from kuglice.picture import png  # noqa: PLC0415 - few worlds are drawn

        try:
            return png(self)
        except MissingExtraError:
            return None
