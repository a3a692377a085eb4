"""What the server says when asked: about, view, history, status; beside the tick loop."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from functools import partial

import zenoh

from kuglice.errors import KugliceError, ProtocolError
from kuglice.protocol import (
    ANY_EPOCH,
    About,
    Admission,
    ArrivalRequest,
    Declared,
    History,
    Keys,
    Message,
    Refusal,
    SnapshotRequest,
    Status,
    TickRange,
    ViewAbout,
    compress,
    decode,
    encode,
    split,
)
from kuglice_server.arrivals import Arrivals
from kuglice_server.history import History as KeptHistory
from kuglice_server.snapshots import Snapshots

__all__ = ["Answers"]

log = logging.getLogger(__name__)

_Tell = Callable[[], Iterator[Message]]
_Route = tuple[Callable[[Callable[[], None]], None], _Tell]
"""What is told, and what runs the answering: at once, or elsewhere."""


class Answers:
    """Queryables of one world.

    `about`, `view` and `status` are called for fresh messages, `settled` for whether a name and session play or were
    refused, `admission` for which of it; all must be safe to call from any thread. Each key has a thread of its own,
    and what must be waited for is waited for elsewhere: whoever measures how long an answer takes, or heals, never
    waits behind somebody's state.
    """

    def __init__(
        self,
        session: zenoh.Session,
        keys: Keys,
        *,
        epoch: int,
        hash_every: int,
        about: Callable[[], About],
        view: Callable[[], ViewAbout],
        status: Callable[[], Status],
        settled: Callable[[str, str], bool],
        admission: Callable[[str, str], Admission],
        history: KeptHistory,
    ) -> None:
        self._epoch = epoch
        self._hash_every = hash_every
        self._about = about
        self._view = view
        self._status = status
        self._admission = admission
        self._history = history
        self._arrivals = Arrivals(settled)
        self._snapshots = Snapshots()
        routes: list[tuple[str, Callable[[zenoh.Query], _Route]]] = [
            (keys.about, lambda query: (_at_once, self._tell_about)),
            (keys.view, lambda query: (_at_once, self._tell_view)),
            (keys.status, self._status_route),
            (keys.history, self._history_route),
        ]
        queryables = [
            session.declare_queryable(key, zenoh.handlers.Callback(partial(self._take, key, route)))
            for key, route in routes
        ]
        self.declared: tuple[Declared, ...] = (*queryables, self._arrivals, self._snapshots)

    def ticked(self) -> None:
        """Another tick was made."""
        self._arrivals.ticked()

    def _take(self, key: str, route: Callable[[zenoh.Query], _Route], query: zenoh.Query) -> None:
        try:
            run, tell = route(query)
            run(partial(self._answer, query, key, tell))
        except KugliceError as error:
            with query:
                query.reply_err(self._refusal(str(error)))

    def _answer(self, query: zenoh.Query, key: str, tell: _Tell) -> None:
        with query:
            try:
                for message in tell():
                    query.reply(key, encode(message))
            except KugliceError as error:
                query.reply_err(self._refusal(str(error)))
            except Exception as error:
                # An asker must not be left waiting, nor the answering thread die, because of a bug of ours.
                log.exception("query on %s failed", key)
                query.reply_err(self._refusal(f"internal error: {error}"))

    def _refusal(self, reason: str) -> bytes:
        return encode(Refusal(epoch=self._epoch, reason=reason[: Refusal.max_reason]))

    def _status_route(self, query: zenoh.Query) -> _Route:
        if query.payload is None:
            return _at_once, self._tell_status
        arrival = decode(query.payload, ArrivalRequest)
        who = arrival.name, arrival.session
        return partial(self._arrivals.answer, *who), partial(self._tell_admission, *who)

    def _history_route(self, query: zenoh.Query) -> _Route:
        payload = query.payload
        if payload is None:
            raise ProtocolError("history: a query needs a payload that says which ticks or which snapshot")
        request = decode(payload, TickRange, SnapshotRequest)
        whichever = isinstance(request, SnapshotRequest) and request.epoch == ANY_EPOCH
        if request.epoch != self._epoch and not whichever:
            raise ProtocolError(f"epoch {request.epoch}: this server runs epoch {self._epoch}")
        if isinstance(request, SnapshotRequest):
            return self._snapshots.answer, partial(self._tell_snapshot, request)
        assert isinstance(request, TickRange)
        return _at_once, partial(self._tell_ticks, request)

    def _tell_about(self) -> Iterator[Message]:
        about = self._about()
        yield from split(compress(encode(about)), of="about", epoch=self._epoch, tick=about.tick)

    def _tell_view(self) -> Iterator[Message]:
        yield self._view()

    def _tell_status(self) -> Iterator[Message]:
        yield self._status()

    def _tell_admission(self, name: str, session: str) -> Iterator[Message]:
        yield self._admission(name, session)

    def _tell_ticks(self, request: TickRange) -> Iterator[Message]:
        ticks = self._history.ticks(request.first, request.end)
        if not ticks:
            raise ProtocolError(f"ticks {request.first} to {request.end - 1}: not kept, or not yet run")
        stretch = History.of(self._epoch, ticks, hash_every=self._hash_every)
        yield from split(compress(encode(stretch)), of="history", epoch=self._epoch, tick=ticks[0].tick)

    def _tell_snapshot(self, request: SnapshotRequest) -> Iterator[Message]:
        at = request.at
        kept = self._history.fresh_snapshot() if at is None else self._history.snapshot(at)
        if kept is None:
            raise ProtocolError(
                "snapshot: none yet" if at is None else f"snapshot at or before {at}: not kept"
            )
        yield from split(self._snapshots.packed(kept), of="snapshot", epoch=self._epoch, tick=kept.tick)


def _at_once(answer: Callable[[], None]) -> None:
    answer()
