"""A view: subscribes to the regions of a rectangle, runs the same step on their balls, hears how they really are."""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from kuglice import Model, Scene, _core
from kuglice.errors import JoinError, KugliceError, ProtocolError
from kuglice.protocol import Holding, Keys, Nodes, Rectangle, ViewAbout, decode
from kuglice_client.ask import Asked
from kuglice_client.correction import Correction
from kuglice_client.join import find_world
from kuglice_client.link import Link
from kuglice_client.run_loop import Frames, run_loop
from kuglice_client.view.accuracy import Accuracy
from kuglice_client.view.clock import ViewClock
from kuglice_client.view.hearing import Hearing
from kuglice_client.view.interest import Interest
from kuglice_client.view.known import KnownWorld
from kuglice_client.view.settings import ViewSettings, check_rectangle
from kuglice_client.view.subscriptions import Subscriptions
from kuglice_client.view.summary import summarise

if TYPE_CHECKING:
    import zenoh

    from kuglice_client.render.moment import Moment

__all__ = ["View"]

log = logging.getLogger(__name__)

Floats = NDArray[np.float64]
Ids = NDArray[np.uint64]

BALANCED_EVERY_SECONDS = 0.5
SILENCE_SECONDS = 3.0
ASKED_EVERY_SECONDS = 1.0
RETRY_SECONDS = 0.03


class View:
    """Connects and subscribes when made; `run` looks until told to stop. A context manager. Raises JoinError."""

    def __init__(self, settings: ViewSettings, stop: threading.Event | None = None) -> None:
        began = time.monotonic()
        deadline = began + settings.wait
        self.settings = settings
        self.stop = stop if stop is not None else threading.Event()
        self.rectangle: Rectangle = settings.rectangle
        self.accuracy = Accuracy()
        self.correction = Correction()
        self.malformed = 0
        self.rejoins = 0
        self.updates = 0
        self.balls_told = 0
        self._balanced_at = began
        self.link = Link(settings.connect, deadline=deadline, stop=self.stop)
        try:
            self._keys = Keys(settings.world or find_world(self.link, deadline=deadline, stop=self.stop))
            self.subscriptions = Subscriptions(self.link.session, self._keys)
            self._enter(self._about(deadline))
        except BaseException:
            self.close()
            raise
        self.joined_at = time.monotonic()
        self.joined_after = self.joined_at - began

    def move(self, rectangle: Rectangle) -> None:
        """Look at (left, bottom, right, top) from now on. Raises ProtocolError for what is no rectangle."""
        self.rectangle = check_rectangle(rectangle)
        self._choose()

    def turn(self, now: float) -> float:
        """Take in what came and step up to now. Returns how far the drawn state is from one tick to the next."""
        self._receive(now)
        self._ask_again(now)
        known = self.known
        if known.unsettled:
            before_id, before = known.world.id, known.world.position
            known.settle()
            world = known.world
            self.correction.moved(before_id, before, world.id, world.position, world.radius)
        target = self.clock.target(now)
        known.advance(math.floor(target))
        self.correction.frame(now, known.world.count)
        if now - self._balanced_at > BALANCED_EVERY_SECONDS:
            self._balanced_at = now
            if self.interest.out_of_balance:
                self._choose()
        return max(0.0, min(1.0, target - known.world.tick))

    def run(
        self,
        *,
        seconds: float | None = None,
        fps: float | None = None,
        each_frame: Callable[[View, float], None] | None = None,
    ) -> None:
        """Look until `stop`, or for that long; `each_frame` gets the view and alpha, `fps` times per second."""

        def frame(alpha: float) -> None:
            if each_frame is not None:
                each_frame(self, alpha)

        run_loop(self.turn, frame, Frames(fps), stop=self.stop, seconds=seconds)

    @property
    def in_sight(self) -> NDArray[np.bool_]:
        """(n,) which balls of `known.world` have their centre in the rectangle."""
        return self._inside(self.known.world.position)

    def summary(self) -> dict[str, Any]:
        """What this session was like, as values for JSON."""
        return summarise(self, seconds=time.monotonic() - self.joined_at)

    def moment(self, alpha: float) -> Moment:
        """What is to be seen of the rectangle: `alpha` of the way from the last tick but one to the last."""
        from kuglice_client.view.picture import moment  # noqa: PLC0415 - the extra `render`

        return moment(self, alpha)

    def close(self, timeout: float = 5.0) -> bool:
        """Leave. False if Zenoh did not finish within `timeout` seconds."""
        return self.link.close(timeout)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _about(self, deadline: float) -> ViewAbout:
        while True:
            try:
                reply = self.link.ask(self._keys.view, None).wait(self.stop)[0]
                return self._checked(decode(reply, ViewAbout))
            except (JoinError, ProtocolError) as error:
                if time.monotonic() > deadline or self.stop.wait(RETRY_SECONDS):
                    raise JoinError(f"{self._keys.view}: {error}") from error

    def _checked(self, about: ViewAbout) -> ViewAbout:
        if about.step_version != _core.STEP_VERSION:
            raise JoinError(
                f"step version {about.step_version} of the server (kuglice {about.version}): this view has "
                f"{_core.STEP_VERSION} and would compute something else"
            )
        return about

    def _enter(self, about: ViewAbout) -> None:
        """Begin, for the first time or after a restart of the server."""
        now = time.monotonic()
        try:
            self.scene = Scene.from_message(about.scene)
            model = Model.from_message(about.model)
            self.nodes = Nodes(self.scene.box, about.regions.depth)
            self._hearing = Hearing(about, self.nodes, now=now)
        except KugliceError as error:
            raise JoinError(f"world {about.world}: {error}") from error
        self.about = about
        self.clock = ViewClock(rate=about.rate, tick=about.tick, now=now)
        self.known = KnownWorld(
            self.scene,
            model,
            tick=about.tick,
            every=max(1, round(about.rate / about.regions.rate)),
            node_of=self._hearing.packer.node,
            compare=self._compare,
        )
        self.interest = Interest(
            self.nodes, rate=about.regions.rate, balls=about.balls, budget=self.settings.budget
        )
        self._margin = self.settings.margin
        if self._margin is None:
            left, bottom, right, top = self.nodes.rectangle(0)
            self._margin = min(right - left, top - bottom) / 2
        self.correction.clear()
        self._newest = about.tick
        self._heard_at = self._asked_at = self._balanced_at = now
        self._asked: Asked | None = None
        self._choose()
        log.info("looking at world %s from tick %d on", about.world, about.tick)

    def _choose(self) -> None:
        assert self._margin is not None
        self.interest.choose(self.rectangle, self._margin)
        self.known.follow(self.interest.paces)
        self.subscriptions.want(self.nodes, self.interest.paces)

    def _receive(self, now: float) -> None:
        samples = self.subscriptions.samples
        while samples:
            sample = samples.popleft()
            try:
                self._hear(sample, now)
            except ProtocolError as error:
                self.malformed += 1
                if self.malformed == 1:
                    log.warning("%s (further ones are only counted)", error)

    def _hear(self, sample: zenoh.Sample, now: float) -> None:
        key, data = str(sample.key_expr), sample.payload.to_bytes()
        if key == self._keys.holding:
            self.link.traffic.received["holding"] += len(data)
            message = decode(data, Holding)
            if message.epoch != self.about.epoch:
                self._ask(now)
                return
            self._hearing.check_tick(message.tick, now=now)
            self.known.hold(message.tick, message.players, message.held)
            tick = message.tick
        else:
            self.link.traffic.received["regions"] += len(data)
            told = self._hearing.region(key, data, now=now)
            if isinstance(told, int):
                self._ask(now)
                return
            self.interest.note(told.node, len(data))
            self.updates += self.known.take(told)
            self.balls_told += len(told.id)
            tick = told.tick
        self._heard_at = now
        if tick > self._newest:
            self._newest = tick
            self.clock.heard(tick, now)

    def _compare(self, ids: Ids, position: Floats, off: Floats) -> None:
        self.accuracy.note(off[self._inside(position)])

    def _inside(self, position: Floats) -> NDArray[np.bool_]:
        left, bottom, right, top = self.rectangle
        x, y = position[:, 0], position[:, 1]
        inside: NDArray[np.bool_] = (x >= left) & (x < right) & (y >= bottom) & (y < top)
        return inside

    def _ask(self, now: float) -> None:
        if self._asked is None and now - self._asked_at > ASKED_EVERY_SECONDS:
            self._asked, self._asked_at = self.link.ask(self._keys.view, None), now

    def _ask_again(self, now: float) -> None:
        """Silence, and news of another epoch, may mean that another server runs now."""
        if now - self._heard_at > SILENCE_SECONDS:
            self._ask(now)
        if self._asked is None:
            return
        try:
            replies = self._asked.poll()
            if replies is None:
                return
            self._asked = None
            about = self._checked(decode(replies[0], ViewAbout))
        except (JoinError, ProtocolError) as error:
            log.debug("nobody says what runs now: %s", error)
            self._asked = None
            return
        if about.epoch != self.about.epoch:
            self.rejoins += 1
            self._enter(about)
