"""The compiled part: kuglice-step and kuglice-raster, converted to numpy and to the errors of kuglice.errors.

Positions, velocities: float64 arrays of shape (n, 2). Radii, masses: (n,). Ids: uint64 (n,). Arrays that a
property returns are copies in id order. Inputs travel as records of INPUT_BYTES bytes each, packed by kuglice.inputs.
"""

from collections.abc import Sequence
from typing import Self, final

import numpy as np
from numpy.typing import NDArray

type Floats = NDArray[np.float64]
type Ids = NDArray[np.uint64]
type Pixels = NDArray[np.uint8]

STEP_VERSION: int
"""Changes when, and only when, some state would step to other bits than before."""
BUILD: dict[str, str]
"""What this module was built with and for: rustc, target, target_features, flags, opt_level."""
MOST_THREADS: int
INTEGRATORS: tuple[str, ...]
CONTACTS: tuple[str, ...]
BROADPHASES: tuple[str, ...]
FORCES: dict[str, tuple[str, ...]]
"""Force kind -> names of its numbers, in the order in which Rules wants them."""
INPUT_KINDS: tuple[str, ...]
"""Index in this tuple = the kind byte of an input record."""
INPUT_BYTES: int
MOST_DEPTH: int
"""Levels of a quadtree of regions, at the most."""
MOST_SHAPES: int
"""(radius, mass) in a table, at the most."""
NO_BALL: int
"""Ball id of an input record that names no ball (a kick of one's own ball)."""

@final
class Rules:
    """What never changes in a world: box, walls, restitution, tick rate, forces."""

    def __new__(
        cls,
        *,
        box: tuple[float, float, float, float],
        walls: bool,
        restitution: float,
        tick_rate: float,
        forces: Sequence[tuple[str, Sequence[float]]],
    ) -> Self: ...
    @staticmethod
    def from_bytes(data: bytes) -> Rules: ...
    def to_bytes(self) -> bytes: ...

@final
class Model:
    """How a world is computed. Raises ModelError for a name or pairing that is not registered."""

    def __new__(
        cls,
        *,
        integrator: str,
        contacts: str,
        broadphase: str,
        substeps: int = 1,
        smallest_node: float | None = None,
    ) -> Self: ...

@final
class World:
    """A state and the step that moves it. Stepping releases the GIL; a world is not to be shared by threads."""

    def __new__(
        cls, rules: Rules, model: Model, *, position: Floats, velocity: Floats, radius: Floats, mass: Floats
    ) -> Self: ...
    @staticmethod
    def with_balls(
        rules: Rules,
        model: Model,
        tick: int,
        *,
        id: Ids,
        position: Floats,
        velocity: Floats,
        radius: Floats,
        mass: Floats,
    ) -> World:
        """A world of some balls only, as they are known at `tick`; ids ascend."""

    def replace(
        self, gone: Ids, *, id: Ids, position: Floats, velocity: Floats, radius: Floats, mass: Floats
    ) -> None:
        """Take balls out, and put balls in or right; ids ascend."""

    def hold(
        self, players: Sequence[tuple[int, int | None]], held: Sequence[tuple[int, str, float, float, float]]
    ) -> None:
        """Make these all the players and held inputs that there are, in the order that the properties have."""

    @staticmethod
    def restore(rules: Rules, model: Model, data: bytes) -> World: ...
    def employ(self, threads: int) -> None:
        """Share the work of a step among so many threads from now on."""

    @property
    def threads(self) -> int: ...
    def step(self, inputs: bytes, dt: float | None = None, budget: int | None = None) -> None:
        """One tick. `inputs` is any number of input records in any order; `dt` overrides 1 / tick_rate.

        `budget` bounds the pairs that `event` looks at; whether it is enough depends on neither threads nor history.
        """

    def run(self, ticks: int) -> None:
        """That many ticks without inputs."""

    def snapshot(self) -> bytes: ...
    def clone(self) -> World: ...
    def copy_from(self, other: World) -> None:
        """Become a copy of other, reusing this world's memory."""

    @property
    def tick(self) -> int: ...
    @property
    def time(self) -> float: ...
    @property
    def next_id(self) -> int: ...
    @property
    def collisions(self) -> int: ...
    @property
    def wall_hits(self) -> int: ...
    @property
    def inputs_applied(self) -> int: ...
    @property
    def inputs_ignored(self) -> int: ...
    @property
    def state_hash(self) -> int: ...
    @property
    def count(self) -> int: ...
    @property
    def id(self) -> Ids: ...
    @property
    def position(self) -> Floats: ...
    @property
    def velocity(self) -> Floats: ...
    @property
    def radius(self) -> Floats: ...
    @property
    def mass(self) -> Floats: ...
    @property
    def kinetic_energy(self) -> float: ...
    @property
    def potential_energy(self) -> float: ...
    @property
    def momentum(self) -> tuple[float, float]: ...
    @property
    def players(self) -> list[tuple[int, int | None]]:
        """(client, id of its ball or None), by client."""

    @property
    def held(self) -> list[tuple[int, str, float, float, float]]:
        """Inputs being held: (client, "thrust" or "attract", x, y, strength), by client."""

    def overlapping(self) -> NDArray[np.uint64]:
        """(k, 2) ids of all pairs that overlap now, sorted, found by this world's broadphase."""

    def nodes(self) -> Floats:
        """(k, 4) rectangles (left, bottom, right, top) of the occupied nodes of a quadtree over the balls now."""

    def lend(self) -> Lease:
        """Zero-copy arrays. Until the lease ends, whatever would change this world raises LentError."""

@final
class Lease:
    """Read-only arrays over a world's own memory, in its order: `id` says whose numbers they are."""

    position: Floats
    velocity: Floats
    radius: Floats
    mass: Floats
    id: Ids

    def end(self) -> None: ...

@final
class Regions:
    """Balls by node of a quadtree of fixed depth over a box, packed to few bytes each (core/regions).

    A node is the number of its path from the root, two bits a level: 0 left bottom, 1 right bottom, 2 left top, 3
    right top. Positions and velocities are rounded to whole quanta, in metres and metres per second; `shapes` are
    (radius, mass) that both ends know. Raises ProtocolError.
    """

    def __new__(
        cls,
        *,
        box: tuple[float, float, float, float],
        depth: int,
        position_quantum: float,
        velocity_quantum: float,
        shapes: Sequence[tuple[float, float]],
    ) -> Self: ...
    def node(self, position: Floats) -> NDArray[np.uint32]:
        """(n,) nodes of points (n, 2); of one outside of the box the nearest."""

    def pack(self, world: World, nodes: Sequence[int]) -> tuple[list[bytes], int]:
        """The balls of each node, found in one pass over all; and how many were too far or fast to be told."""

    def unpack(self, data: bytes, most: int) -> tuple[Ids, Floats, Floats, Floats, Floats]:
        """id, position, velocity, radius, mass; ids ascend. ProtocolError for what `pack` did not make."""

def recording(world: World, ticks: Sequence[bytes]) -> bytes:
    """A run as bytes that the example `rerun` of kuglice-step can make again: the world as it is, inputs per tick."""

def random_uniform(seed: int, stream: int, first: int, count: int) -> Floats:
    """Numbers `first .. first + count` of a counter-based generator, in [0, 1); equal on every platform."""

def draw_discs(
    pixels: Pixels,
    center: Floats,
    radius: Floats,
    colour: Pixels,
    shaded: bool = False,
) -> None:
    """Blend filled anti-aliased discs onto `pixels` (height, width, 3), in order, in place.

    `center` (n, 2) and `radius` (n,) in pixels, the origin at the top left corner of the top left pixel, y downwards;
    `colour` (n, 4): red, green, blue, opacity, 0-255. `shaded` lights them as balls, whose middle keeps the colour.
    What lies outside the picture is clipped. All drawing functions raise ValueError for arrays of a wrong shape.
    """

def draw_rings(pixels: Pixels, center: Floats, radius: Floats, thickness: float, colour: Pixels) -> None:
    """Blend rings between `radius - thickness` and `radius`; the rest as for discs."""

def draw_segments(
    pixels: Pixels, start: Floats, end: Floats, thickness: Floats, colour: Pixels, lighten: bool = False
) -> None:
    """Blend line segments with round ends: `start` and `end` (n, 2), `thickness` (n,), `colour` (n, 4).

    `lighten` keeps what is lighter already, so that joints of a trail are no brighter than the rest.
    """

def draw_rectangles(pixels: Pixels, rectangle: Floats, thickness: float, colour: Pixels) -> None:
    """Blend outlines, centred on the edges of `rectangle` (n, 4): left, top, right, bottom. `colour` (n, 4)."""

def draw_fluid(
    pixels: Pixels,
    center: Floats,
    radius: Floats,
    value: Floats,
    palette: Pixels,
    opacity: float,
    window: tuple[int, int, int, int] | None = None,
) -> None:
    """Blend balls as one liquid surface. `value` (n,) within 0 and 1 chooses from `palette` (k, 3).

    `window` (first column, first row, last column + 1, last row + 1) is the part of the picture that may get wet.
    """

def fade(pixels: Pixels, target: Pixels, keep: int) -> None:
    """Move `pixels` towards `target` of the same shape, keeping `keep` / 256 of the difference."""
