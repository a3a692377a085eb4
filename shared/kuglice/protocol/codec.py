"""Messages to bytes and back: bounded before they are decoded, validated before they are used."""

from __future__ import annotations

import reprlib
from collections.abc import Sequence
from typing import Any, TypeVar

import msgpack
import zenoh
from pydantic import ValidationError

from kuglice.errors import ProtocolError
from kuglice.protocol.messages.envelope import PROTOCOL_VERSION, CompactMessage, Message

__all__ = ["Payload", "decode", "encode"]


M = TypeVar("M", bound=Message)
Payload = bytes | zenoh.ZBytes
"""What came in stays where Zenoh has it until its size is known: `to_bytes` would copy as much as anybody sends."""

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = 80


def encode(message: Message) -> bytes:
    """A msgpack map: version `v`, kind, and the message's own fields; one that is compact has bytes of its own.

    Raises ProtocolError if it is too large.
    """
    data: bytes = (
        message.to_bytes()
        if isinstance(message, CompactMessage)
        else msgpack.packb({"v": PROTOCOL_VERSION, **message.to_body()})
    )
    if len(data) > message.max_bytes:
        raise ProtocolError(
            f"message {message.kind!r}: {len(data)} bytes, at most {message.max_bytes} allowed"
        )
    return data


def decode(payload: Payload, *kinds: type[M]) -> M:
    """The message in `payload`, which must be one of `kinds`; raises ProtocolError whatever the bytes are.

    Of one that is too large nothing is copied.
    """
    names = " or ".join(repr(kind.kind) for kind in kinds)
    bound = max(kind.max_bytes for kind in kinds)
    if len(payload) > bound:
        raise ProtocolError(f"message {names}: {len(payload)} bytes, at most {bound} allowed")
    data = bytes(payload)
    compact = _compact_kind(data, kinds)
    body = {} if compact is not None else _unpack(data, names)
    kind = compact or next((kind for kind in kinds if _is(kind, body)), None)
    version = body.pop("v", None) if compact is None else next(iter(data[1:2]), None)
    if version != PROTOCOL_VERSION:
        raise ProtocolError(
            f"message {names}: protocol version {_SHORT.repr(version)}, this side speaks {PROTOCOL_VERSION}"
        )
    if kind is None:
        raise ProtocolError(f"message {_SHORT.repr(body.get('kind', list(body)))}: expected {names}")
    if len(data) > kind.max_bytes:
        raise ProtocolError(f"message {kind.kind!r}: {len(data)} bytes, at most {kind.max_bytes} allowed")
    try:
        if issubclass(kind, CompactMessage):
            return kind.read(data[2:])
        del body["kind"]
        return kind.from_body(body)
    except ValidationError as error:
        raise ProtocolError(f"message {kind.kind!r}: {_first(error)}") from error
    except ProtocolError as error:
        raise ProtocolError(f"message {kind.kind!r}: {error}") from error


def _compact_kind(data: bytes, kinds: Sequence[type[M]]) -> type[M] | None:
    # No msgpack map begins with a letter.
    return next(
        (kind for kind in kinds if issubclass(kind, CompactMessage) and data[:1] == kind.letter), None
    )


def _is(kind: type[Message], body: dict[str, Any]) -> bool:
    return not issubclass(kind, CompactMessage) and bool(body.get("kind") == kind.kind)


def _unpack(data: bytes, names: str) -> dict[str, Any]:
    # No collection can have more members than the message has bytes, whatever its header claims.
    bound = len(data)
    try:
        body = msgpack.unpackb(
            data,
            strict_map_key=True,
            max_str_len=bound,
            max_bin_len=bound,
            max_array_len=bound,
            max_map_len=bound,
            max_ext_len=0,
        )
    except (ValueError, TypeError, RecursionError, msgpack.UnpackException) as error:
        # msgpack's own errors are ValueErrors too, and some of them carry no text.
        raise ProtocolError(f"message {names}: not msgpack: {str(error) or type(error).__name__}") from error
    if not isinstance(body, dict):
        raise ProtocolError(f"message {names}: a {type(body).__name__}, not a map")
    return body


def _first(error: ValidationError) -> str:
    problem = error.errors(include_url=False)[0]
    where = ".".join(str(step) for step in problem["loc"]) or "message"
    if problem["type"] == "missing":
        return f"{where}: missing"
    return f"{where}: {problem['msg']}, not {_SHORT.repr(problem['input'])}"
