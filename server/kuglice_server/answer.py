"""What the server says when asked: about, view, history, status; on Zenoh's threads, beside the tick loop."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from typing import Any

import zenoh

from kuglice.errors import KugliceError, ProtocolError
from kuglice.protocol import (
    ANY_EPOCH,
    About,
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
from kuglice_server.history import History as KeptHistory

__all__ = ["Answers"]

log = logging.getLogger(__name__)


class Answers:
    """Queryables of one world.

    `about`, `view` and `status` are called for fresh messages, `settle` to wait, for a moment, until it is clear
    whether a name and session play; all must be safe to call from any thread.
    """

    def __init__(
        self,
        session: zenoh.Session,
        keys: Keys,
        *,
        epoch: int,
        about: Callable[[], About],
        view: Callable[[], ViewAbout],
        status: Callable[[], Status],
        settle: Callable[[str, str], None],
        history: KeptHistory,
    ) -> None:
        self._epoch = epoch
        self._about = about
        self._view = view
        self._status = status
        self._settle = settle
        self._history = history
        handlers: list[tuple[str, Callable[[zenoh.Query], Iterator[Message]]]] = [
            (keys.about, self._answer_about),
            (keys.view, self._answer_view),
            (keys.status, self._answer_status),
            (keys.history, self._answer_history),
        ]
        self.declared: tuple[Declared, ...] = tuple(
            session.declare_queryable(key, zenoh.handlers.Callback(self._guarded(key, handler)))
            for key, handler in handlers
        )

    def _guarded(
        self, key: str, handler: Callable[[zenoh.Query], Iterator[Message]]
    ) -> Callable[[zenoh.Query], Any]:
        def answer(query: zenoh.Query) -> None:
            with query:
                try:
                    for message in handler(query):
                        query.reply(key, encode(message))
                except KugliceError as error:
                    query.reply_err(encode(Refusal(epoch=self._epoch, reason=str(error)[:2000])))
                except Exception as error:
                    # An asker must not be left waiting, nor the answering thread die, because of a bug of
                    # ours.
                    log.exception("query on %s failed", key)
                    query.reply_err(
                        encode(Refusal(epoch=self._epoch, reason=f"internal error: {error}"[:2000]))
                    )

        return answer

    def _answer_about(self, query: zenoh.Query) -> Iterator[Message]:
        about = self._about()
        yield from split(compress(encode(about)), of="about", epoch=self._epoch, tick=about.tick)

    def _answer_view(self, query: zenoh.Query) -> Iterator[Message]:
        yield self._view()

    def _answer_status(self, query: zenoh.Query) -> Iterator[Message]:
        if query.payload is not None:
            arrival = decode(query.payload.to_bytes(), ArrivalRequest)
            self._settle(arrival.name, arrival.session)
        yield self._status()

    def _answer_history(self, query: zenoh.Query) -> Iterator[Message]:
        payload = query.payload
        if payload is None:
            raise ProtocolError("history: a query needs a payload that says which ticks or which snapshot")
        request = decode(payload.to_bytes(), TickRange, SnapshotRequest)
        whichever = isinstance(request, SnapshotRequest) and request.epoch == ANY_EPOCH
        if request.epoch != self._epoch and not whichever:
            raise ProtocolError(f"epoch {request.epoch}: this server runs epoch {self._epoch}")
        about = self._about()
        if isinstance(request, TickRange):
            ticks = self._history.ticks(request.first, request.end)
            if not ticks:
                raise ProtocolError(f"ticks {request.first} to {request.end - 1}: not kept, or not yet run")
            stretch = History.of(self._epoch, ticks, hash_every=about.hash_every)
            yield from split(compress(encode(stretch)), of="history", epoch=self._epoch, tick=ticks[0].tick)
        elif isinstance(request, SnapshotRequest):
            at = request.at
            kept = self._history.fresh_snapshot() if at is None else self._history.snapshot(at)
            if kept is None:
                raise ProtocolError(
                    "snapshot: none yet" if at is None else f"snapshot at or before {at}: not kept"
                )
            data = compress(kept.data, numbers=True)
            yield from split(data, of="snapshot", epoch=self._epoch, tick=kept.tick)
