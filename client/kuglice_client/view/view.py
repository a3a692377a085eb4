"""A view: subscribes to the regions of a rectangle, runs the same step on their balls, hears how they really are."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from kuglice.closing import Closing
from kuglice.errors import ProtocolError
from kuglice.protocol import Keys, Rectangle, ViewAbout
from kuglice_client.correction import Correction
from kuglice_client.join import find_world
from kuglice_client.link import DatagramWatch, Link, Renewal, Waiting
from kuglice_client.run_loop import Frames, run_loop
from kuglice_client.totals import Totals
from kuglice_client.view.accuracy import Accuracy
from kuglice_client.view.inquiry import Inquiry
from kuglice_client.view.partial_replica import PartialReplica
from kuglice_client.view.settings import ViewSettings, check_rectangle
from kuglice_client.view.subscriptions import Subscriptions
from kuglice_client.view.summary import figures, summarise
from kuglice_client.view.told import Floats, Ids

if TYPE_CHECKING:
    from kuglice_client.render.moment import Moment

__all__ = ["View"]

log = logging.getLogger(__name__)

ARRIVE_SECONDS = 0.5
"""Who has not been told of everything in sight by then is shown what there is."""
ARRIVE_IDLE_SECONDS = 0.001


class View(Closing):
    """Connects and subscribes when made; `run` looks until told to stop. A context manager. Raises JoinError.

    Its link, rectangle and totals last; its `replica` is of one run of the server.
    """

    def __init__(self, settings: ViewSettings, stop: threading.Event | None = None) -> None:
        began = time.monotonic()
        deadline = began + settings.wait
        self.settings = settings
        self.stop = stop if stop is not None else threading.Event()
        self.rectangle: Rectangle = settings.rectangle
        self.accuracy = Accuracy()
        self.correction = Correction()
        self.malformed = 0
        self._silent = False
        self.totals = Totals()
        self.link = Link(settings.connect, deadline=deadline, stop=self.stop)
        self.renewal = Renewal(self.link, DatagramWatch(self.link))
        try:
            waiting = Waiting(self.link, began=began, wait=settings.wait, stop=self.stop)
            self._keys = Keys(settings.world or find_world(waiting))
            self._inquiry = Inquiry(self.link, self._keys)
            about = self._inquiry.wait(waiting)
            # Only now: while it waited, the link may have taken another session.
            self.subscriptions = Subscriptions(self.link.session, self._keys)
            self._enter(about)
            self._arrive()
        except BaseException:
            self.close()
            raise
        self.joined_at = time.monotonic()
        self.joined_after = self.joined_at - began

    def move(self, rectangle: Rectangle) -> None:
        """Look at (left, bottom, right, top) from now on. Raises ProtocolError for what is no rectangle."""
        self.rectangle = check_rectangle(rectangle)
        self._look()

    def turn(self, now: float) -> float:
        """Take in what came and step up to now. Returns how far the drawn state is from one tick to the next.

        Raises JoinError if the server was restarted as one that cannot be followed.
        """
        self._receive(now)
        self._heed_silence(now)
        alpha = self.replica.advance(now, self.correction)
        if self.replica.out_of_balance(now):
            self._look()
        return alpha

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
        """(n,) which balls of `replica.known.world` have their centre in the rectangle."""
        return self._inside(self.replica.known.world.position)

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

    def _enter(self, about: ViewAbout) -> None:
        """Begin, for the first time or after a restart of the server."""
        self.replica = PartialReplica(about, self.settings, compare=self._compare, now=time.monotonic())
        self.correction.clear()
        self._look()
        log.info("looking at world %s from tick %d on", about.world, about.tick)

    def _arrive(self) -> None:
        """Hear of all that is in sight, before anybody sees it piece by piece."""
        until = time.monotonic() + ARRIVE_SECONDS
        while (now := time.monotonic()) < until and not self.replica.interest.complete:
            self.turn(now)
            if self.stop.wait(ARRIVE_IDLE_SECONDS):
                return

    def _look(self) -> None:
        self.replica.look_at(self.rectangle)
        self.subscriptions.want(self.replica.nodes, self.replica.interest.asked_for)

    def _receive(self, now: float) -> None:
        samples = self.subscriptions.samples
        while samples:
            sample = samples.popleft()
            key, payload = str(sample.key_expr), sample.payload
            what = "holding" if key == self._keys.holding else "regions"
            self.link.traffic.received[what] += len(payload)
            try:
                ours = self.replica.hear(key, payload, now)
            except ProtocolError as error:
                self.malformed += 1
                if self.malformed == 1:
                    log.warning("%s (further ones are only counted)", error)
                continue
            if not ours:
                self._inquiry.ask(now)

    def _heed_silence(self, now: float) -> None:
        """It may mean that another server runs now, which is asked, or that the link is no more, which is renewed.

        Raises JoinError if it is another server, which speaks or steps otherwise.
        """
        silent = self.replica.silent(now)
        if silent and not self._silent:
            log.warning("no news of world %s for %g s", self._keys.world, self.replica.silence_seconds)
        self._silent = silent
        if silent:
            self._inquiry.ask(now)
        about = self._inquiry.answer()
        goes_on = about is not None and self.replica.overdue(about)
        if self.renewal.turn(now, silent=silent, answered=goes_on, busy=False):
            self.subscriptions.go_over(self.link.session)
        if about is not None and about.epoch != self.replica.about.epoch:
            log.warning("world %s was restarted: looked at again", self._keys.world)
            self.totals.rejoin(figures(self.replica))
            self._enter(about)

    def _compare(self, ids: Ids, position: Floats, off: Floats) -> None:
        self.accuracy.note(off[self._inside(position)])

    def _inside(self, position: Floats) -> NDArray[np.bool_]:
        left, bottom, right, top = self.rectangle
        x, y = position[:, 0], position[:, 1]
        inside: NDArray[np.bool_] = (x >= left) & (x < right) & (y >= bottom) & (y < top)
        return inside
