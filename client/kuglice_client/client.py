"""A headless client: joins, follows, predicts, acts, reconciles; one thread, and Zenoh's fill its rings."""

from __future__ import annotations

import logging
import secrets
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from kuglice import World
from kuglice.closing import Closing
from kuglice.errors import JoinError
from kuglice.inputs import Input
from kuglice.protocol import Keys
from kuglice.study.recorder import StudyRecorder
from kuglice_client.join import Joined, Who, find_world, join
from kuglice_client.link import DatagramWatch, Link, Renewal, Waiting
from kuglice_client.outbox import Outcome
from kuglice_client.pace import judge_pace, step_seconds
from kuglice_client.prediction import Floats, Ids
from kuglice_client.replica import Replica
from kuglice_client.run_loop import Frames, run_loop
from kuglice_client.screen import Screen
from kuglice_client.settings import ClientSettings
from kuglice_client.summary import figures, summarise
from kuglice_client.totals import Totals

if TYPE_CHECKING:
    from kuglice_client.render.moment import Moment

__all__ = ["Client"]

log = logging.getLogger(__name__)

SESSION_BYTES = 8


class Client(Closing):
    """Connects and joins when made; `run` plays until told to stop. A context manager. Raises JoinError.

    So does `run`, with the reason, if the server dismisses the player, or will not have it back after a cut or a
    restart. Its link, screen and totals last; its `replica` is of one run of the server.
    """

    def __init__(self, settings: ClientSettings, stop: threading.Event | None = None) -> None:
        began = time.monotonic()
        deadline = began + settings.wait
        self.settings = settings
        self.stop = stop if stop is not None else threading.Event()
        self.totals = Totals()
        self.screen = Screen(seconds=settings.correction_seconds, limit=settings.correction_limit)
        self._study: StudyRecorder | None = None
        # Tells us from another who takes the same name; whoever is cut off and comes back is the same still.
        self._session = secrets.token_hex(SESSION_BYTES)
        self.link = Link(settings.connect, deadline=deadline, stop=self.stop)
        self.renewal = Renewal(self.link, DatagramWatch(self.link))
        try:
            waiting = Waiting(self.link, began=began, wait=settings.wait, stop=self.stop)
            world = settings.world or find_world(waiting)
            self._keys = Keys(world)
            # First the stream, then the rest: what happens while we join is in its buffer.
            self.link.listen(self._keys, snapshots=settings.check_snapshots)
            if settings.name is not None:
                self.link.show(settings.name, self._session)
            joined = self._join(waiting)
            # Not before: who does not get in must not cost a study of an earlier time.
            self._study = None if settings.study is None else StudyRecorder(settings.study)
            self._enter(joined, deadline)
        except BaseException:
            self.close()
            raise
        self._joined_at = time.monotonic()
        self.joined_after = self._joined_at - began

    @property
    def confirmed(self) -> World:
        """The world as the server has it."""
        return self.replica.follower.world

    @property
    def own(self) -> int | None:
        """Id of one's own ball, once it exists."""
        return None if self.replica.player is None else self.replica.player.ball

    def act(self, given: Input) -> Input:
        """Do something at the next tick that is predicted, or `input_delay` ticks later. It is seen at once.

        Returns it with the client and sequence number that are filled in here. Whether the server takes it
        shows a round trip later in `outcomes`; one that it refuses is taken back from the prediction.

        Raises JoinError for a spectator, and when too much is unacknowledged to add more.
        """
        if self.replica.player is None:
            raise JoinError("a spectator cannot act: join with a name")
        return self.replica.player.act(given, time.monotonic())

    def outcomes(self) -> list[Outcome]:
        """What became of own inputs, as far as was told since the last call: the last 256 at the most.

        A server that restarts tells nothing of what was sent to it before.
        """
        return [] if self.replica.player is None else self.replica.player.outcomes()

    def turn(self, now: float) -> float:
        """Take in what came, predict up to now, send. `frame` is to be called for each frame that is drawn of it.

        Returns how far the drawn state is from one tick to the next. Where the server was started again, or has given
        our player up, this joins again first, which takes the settings' `wait` at most. Raises JoinError if that fails,
        or the server will not have us any more.
        """
        self.replica.receive(now)
        self.replica.heal(now)
        if self.replica.over:
            self._end_or_rejoin()
        replica = self.replica
        answered = replica.healing.brought is not None
        if self.renewal.turn(now, silent=replica.stream.silent(now), answered=answered, busy=replica.busy):
            datagrams = "udp" in self.link.kinds or self.link.owes_datagrams
            replica.clock.relinked(now, in_order=not datagrams)
        self.screen.alpha = replica.advance(now)
        return self.screen.alpha

    def frame(self, now: float) -> None:
        """A frame is drawn: what can be seen in it is counted."""
        prediction = self.replica.prediction
        self.screen.frame(now, prediction)
        if self._study is not None:
            self._study.frame(now, prediction.shown[1], self.screen.alpha, self.confirmed.tick, self._seen)

    def run(
        self,
        *,
        seconds: float | None = None,
        fps: float | None = None,
        each_frame: Callable[[Client, float], None] | None = None,
    ) -> None:
        """Play until `stop`, or for that long.

        `each_frame` gets the client and alpha, `fps` times per second: a film leaves no frame out. Without `fps`
        it is as on a screen, which does.
        """

        def frame(alpha: float) -> None:
            self.frame(time.monotonic())
            if each_frame is not None:
                each_frame(self, alpha)

        run_loop(self.turn, frame, Frames(fps), stop=self.stop, seconds=seconds)

    def summary(self) -> dict[str, Any]:
        """What this session was like, as values for JSON."""
        return summarise(
            self.replica,
            self.screen,
            self.link,
            self.totals,
            name=self.settings.name,
            renewals=self.renewal.renewals,
            joined_after=self.joined_after,
            step_seconds=self.step_seconds,
            seconds=time.monotonic() - self._joined_at,
        )

    def moment(self, alpha: float, *, nodes: bool = False) -> Moment:
        """What is to be seen: `alpha` of the way from the last but one predicted state to the last."""
        from kuglice_client.interpolation import interpolate  # noqa: PLC0415 - the extra `render`
        from kuglice_client.render.moment import HashState  # noqa: PLC0415 - the extra `render`

        wrong = self.replica.reconciler.wrong_since is not None
        state = HashState(self.confirmed.state_hash, self.confirmed.tick, "different" if wrong else "equal")
        moment = interpolate(*self.replica.prediction.shown, alpha, state, nodes=nodes)
        silent = self.replica.silent(time.monotonic())
        return replace(moment, position=self.screen.seen(moment.id, moment.position), silent=silent)

    def close(self, timeout: float = 5.0) -> bool:
        """Leave. False if Zenoh did not finish within `timeout` seconds."""
        if self._study is not None:
            self._study.close()
        return self.link.close(timeout)

    @property
    def _who(self) -> Who | None:
        return None if self.settings.name is None else (self.settings.name, self._session)

    def _join(self, waiting: Waiting) -> Joined:
        return join(waiting, self._keys, self._who)

    def _enter(self, joined: Joined, deadline: float) -> None:
        """Begin in a world that was just joined, for the first time or after a restart of the server."""
        about, settings = joined.about, self.settings
        self.step_seconds = step_seconds(joined.world)
        judge_pace(self.step_seconds, rate=about.rate, balls=joined.world.count)
        now = time.monotonic()
        self.replica = Replica(
            joined,
            self.link,
            self._keys,
            settings,
            who=self._who,
            screen=self.screen,
            study=self._study,
            totals=self.totals,
            now=now,
        )
        self.screen.entered()
        if self._study is not None:
            self._study.joined(
                now,
                joined.world,
                name=settings.name,
                number=joined.number,
                epoch=joined.epoch,
                rate=about.rate,
            )
        self.replica.enter(deadline=deadline, stop=self.stop)
        whom = "a spectator" if joined.number is None else f"client {joined.number}"
        log.info("joined world %s at tick %d as %s", about.world, joined.world.tick, whom)

    def _end_or_rejoin(self) -> None:
        """The server was started again, or has given our player up. Raises JoinError if it will not have us back."""
        if self.replica.refused is not None and not self.replica.credibility.restarted:
            log.warning("the server has given client %s up", self.settings.name)
            raise JoinError(f"client {self.settings.name}: {self.replica.refused}")
        if self.replica.credibility.restarted:
            log.warning("world %s was restarted: it is joined again", self._keys.world)
        else:
            log.warning("the server has given client %s up: it joins again", self.settings.name)
        began, wait = time.monotonic(), self.settings.wait
        joined = self._join(Waiting(self.link, began=began, wait=wait, stop=self.stop))
        self.totals.rejoin(figures(self.replica, self.screen))
        self._enter(joined, began + wait)

    def _seen(self) -> tuple[Ids, Floats]:
        """Ids and positions of the balls of the last frame."""
        ids, position = self.replica.prediction.drawn(self.screen.alpha)
        return ids, self.screen.seen(ids, position)
