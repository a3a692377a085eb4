"""The predicted world: ahead of the confirmed one, so that own inputs act at once.

Others' inputs are predicted too: what they hold, they go on holding. When the authoritative inputs of a tick
equal the predicted ones, the states do as well, and nothing is computed again; otherwise the confirmed world
is copied and run forward.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kuglice import World
from kuglice._core import INPUT_BYTES
from kuglice.blending import blend
from kuglice.budget import tick_budget
from kuglice.errors import StepError
from kuglice.inputs import Input, pack
from kuglice.protocol import StretchedTick

__all__ = ["Prediction"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]


class Prediction:
    """`world` is state(world.tick) as far as it can be known, `previous` the state one tick before it.

    At most `limit` ticks are predicted: what comes later waits.
    """

    def __init__(self, confirmed: World, *, limit: int) -> None:
        self.world = confirmed.clone()
        self.previous = confirmed.clone()
        self.limit = limit
        self._own: dict[int, list[Input]] = {}
        self._promised: dict[int, list[Input]] = {}
        self._used: dict[int, bytes] = {}
        self._wrong = False
        self._stuck = False
        self.rollbacks = 0
        self.deepest_rollback = 0
        self.ticks_rerun = 0
        self.worst_correction = 0.0
        self.held_back = 0

    def act(self, given: Input, tick: int) -> None:
        """An own input that is expected to act in `tick`, which is not predicted yet."""
        self._own.setdefault(tick, []).append(given)

    def settle(self, given: Input, planned: int, tick: int | None) -> None:
        """The server said in which tick an own input acts (None: in none, it was refused)."""
        if tick is not None:
            self._promised.setdefault(tick, []).append(given)
        if tick == planned:
            return
        if self._forget(given, planned) and tick is not None:
            self._own.setdefault(tick, []).append(given)
        self._wrong = (
            self._wrong or planned < self.world.tick or (tick is not None and tick < self.world.tick)
        )

    def confirm(self, entry: StretchedTick) -> None:
        """The authoritative inputs of a tick.

        Own ones that are neither in them nor answered yet wait for the next. One that was promised for this
        tick is not waited for: the server could not make the tick with it.
        """
        promised = self._promised.get(entry.tick, [])
        self._promised = {tick: given for tick, given in self._promised.items() if tick > entry.tick}
        mine = [given for given in self._own.pop(entry.tick, []) if given not in promised]
        told = {entry.inputs[at : at + INPUT_BYTES] for at in range(0, len(entry.inputs), INPUT_BYTES)}
        left = [given for given in mine if pack([given]) not in told]
        if left:
            self._own[entry.tick + 1] = left + self._own.get(entry.tick + 1, [])
        used = self._used.pop(entry.tick, None)
        if used != entry.inputs:
            self._wrong = True

    def reconcile(self, confirmed: World) -> bool:
        """Run forward again from the confirmed world if the prediction was wrong; whether that was so."""
        wrong, reached = self._wrong, self.world.tick
        self._wrong = False
        self._stuck = self._stuck and reached >= confirmed.tick and not wrong
        if reached < confirmed.tick:
            # Nothing was predicted beyond this: no guess was wrong, the stream is just ahead of us.
            self.previous.copy_from(self.world if reached == confirmed.tick - 1 else confirmed)
            self.world.copy_from(confirmed)
            self._used.clear()
            return False
        if not wrong:
            return False
        ids, positions = self.world.id, self.world.position
        self.world.copy_from(confirmed)
        self._used.clear()
        self._run_to(min(reached, confirmed.tick + self.limit))
        self.rollbacks += 1
        self.deepest_rollback = max(self.deepest_rollback, self.world.tick - confirmed.tick)
        self.ticks_rerun += self.world.tick - confirmed.tick
        self.worst_correction = max(self.worst_correction, self._correction(ids, positions))
        return True

    @property
    def wrong(self) -> bool:
        """Whether a guess is known to have been wrong, and `reconcile` has work to do."""
        return self._wrong

    def drawn(self, alpha: float) -> tuple[Ids, Floats]:
        """Ids and positions (n, 2), `alpha` of the way from the previous state to the present one."""
        before, now = self.previous, self.world
        return now.id, blend(before.id, before.position, now.id, now.position, alpha)

    def distrust(self) -> None:
        """The confirmed world was replaced: run forward again from it, whatever was predicted."""
        self._wrong = True

    def may_step(self, confirmed: World) -> bool:
        """Whether one more tick may be predicted."""
        if not self._stuck and self.world.tick - confirmed.tick < self.limit:
            return True
        self.held_back += 1
        return False

    def step(self) -> None:
        """Predict one more tick."""
        self._run_to(self.world.tick + 1)

    def _run_to(self, tick: int) -> None:
        while self.world.tick < tick:
            now = self.world.tick
            inputs = pack(sorted(self._own.get(now, []), key=lambda one: one.sequence))
            if now == tick - 1:
                self.previous.copy_from(self.world)
            try:
                self.world.step(inputs, budget=tick_budget(self.world))
            except StepError:
                # The server does not make this tick either; what it gives up so that it can, only it knows.
                self._stuck = True
                return
            self._used[now] = inputs

    def _forget(self, given: Input, planned: int) -> bool:
        # It may have been moved on from where it was planned, when that tick was confirmed without it.
        for tick in [planned, *(tick for tick in self._own if tick > planned)]:
            waiting = self._own.get(tick, [])
            if given in waiting:
                waiting.remove(given)
                return True
        return False

    def _correction(self, ids: np.ndarray, positions: np.ndarray) -> float:
        """Largest distance, in radii, that a ball moved by running forward again."""
        _, before, after = np.intersect1d(ids, self.world.id, assume_unique=True, return_indices=True)
        if not len(before):
            return 0.0
        moved = self.world.position[after] - positions[before]
        radii = self.world.radius[after]
        return float((np.hypot(moved[:, 0], moved[:, 1]) / radii).max())
