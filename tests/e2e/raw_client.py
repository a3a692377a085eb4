"""A client without manners: speaks the protocol by hand, so that it can say what a real one never would."""

from __future__ import annotations

import secrets
import time
from typing import Any, Self

import zenoh

from e2e.processes import until
from kuglice.errors import ProtocolError
from kuglice.inputs import Input
from kuglice.protocol import (
    Ack,
    ClientInputs,
    Keys,
    SentInput,
    Status,
    Tick,
    client_configuration,
    close_session,
    decode,
    encode,
    open_session,
)

__all__ = ["RawClient"]


class RawClient:
    def __init__(self, endpoint: str, world: str, name: str | None) -> None:
        self.keys = Keys(world)
        self.name = name
        self.session_id = secrets.token_hex(8)
        deadline = time.monotonic() + 30
        while True:
            try:
                self.session = open_session(client_configuration([endpoint], timeout=1.0))
                break
            except ProtocolError:
                assert time.monotonic() < deadline, f"{endpoint}: no server"
        self._declared: list[Any] = [
            self.session.declare_subscriber(self.keys.tick, zenoh.handlers.RingChannel(4096))
        ]
        self._ticks = self._declared[0]
        self.acks: dict[int | None, Ack] = {}
        self.tick = -1
        until(self.status, what="status")
        if name is not None:
            self._declared.append(
                self.session.liveliness().declare_token(self.keys.client(name, self.session_id))
            )
            until(lambda: name in self.status().clients, what=f"{name} is let in")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        close_session(self.session, reversed(self._declared))

    def status(self) -> Status | None:
        for reply in self.session.get(self.keys.status, timeout=30.0):
            if reply.ok is not None:
                return decode(reply.ok.payload.to_bytes(), Status)
        return None

    @property
    def number(self) -> int:
        return self.status().clients[self.name].number

    def listen(self) -> list[Tick]:
        """Take in what came; remembers outcomes and the newest tick."""
        messages = []
        while (sample := self._ticks.try_recv()) is not None:
            if str(sample.key_expr) != self.keys.tick:
                continue
            message = decode(sample.payload.to_bytes(), Tick)
            messages.append(message)
            self.tick = max(self.tick, message.end)
            for ack in message.acks:
                self.acks.setdefault(ack.sequence, ack)
        return messages

    def put(self, key: str, payload: bytes) -> None:
        """Out to the others only: what one puts oneself would come back to one's own subscriber."""
        # What a busy machine cannot take at once is to be waited for, and not dropped as the default is.
        self.session.put(
            key,
            payload,
            congestion_control=zenoh.CongestionControl.BLOCK,
            allowed_destination=zenoh.Locality.REMOTE,
        )

    def raw(self, payload: bytes, name: str | None = None, session: str | None = None) -> None:
        self.put(self.keys.input(name or self.name, session or self.session_id), payload)

    def send(
        self, *wanted: tuple[int, int, Input], epoch: int | None = None, name: str | None = None
    ) -> None:
        """(sequence, tick, input) each, in one message."""
        sent = [
            SentInput(tick, given.model_copy(update={"sequence": sequence}))
            for sequence, tick, given in wanted
        ]
        self.raw(encode(ClientInputs(epoch=epoch or self.status().epoch, heard=0, inputs=sent)), name)

    def answer(self, sequence: int | None) -> Ack:
        """What became of an input, waited for."""

        def heard() -> bool:
            self.listen()
            return sequence in self.acks

        until(heard, what=f"an answer to {sequence}")
        return self.acks[sequence]
