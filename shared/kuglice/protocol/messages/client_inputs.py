"""What a client wants to do. Who it is comes from the key it puts on, never from here."""

from __future__ import annotations

from typing import Annotated, ClassVar, NamedTuple, Self

from pydantic import Field

from kuglice.errors import InputError, ProtocolError
from kuglice.inputs import Input, pack, unpack
from kuglice.protocol.compact import RecordReader, RecordWriter
from kuglice.protocol.messages.envelope import CompactMessage, TickNumber
from kuglice.protocol.varint import Reader, write_signed, write_varint

__all__ = ["MAX_INPUTS", "ClientInputs", "SentInput"]

MAX_INPUTS = 64


class SentInput(NamedTuple):
    """One input, meant for `tick`. Its client goes unsaid, and is 0 here."""

    tick: TickNumber
    given: Input


class ClientInputs(CompactMessage):
    """Everything that the client has not seen acknowledged yet, oldest first; nothing is a mere sign of life.

    `heard` is the tick that the client misses: it has everything before it, and the server need not repeat
    that.

    On the wire: epoch and `heard` (varints), and for each input the tick, as its distance from the tick of
    the input before it or from `heard` (signed), and the record (protocol/compact.py).
    """

    kind: ClassVar[str] = "inputs"
    letter: ClassVar[bytes] = b"i"
    max_bytes: ClassVar[int] = 16 << 10

    heard: TickNumber
    inputs: Annotated[list[SentInput], Field(max_length=MAX_INPUTS)]

    def write(self, out: bytearray) -> None:
        """Append the fields."""
        write_varint(out, self.epoch)
        write_varint(out, self.heard)
        writer, last = RecordWriter(out), self.heard
        for tick, given in self.inputs:
            write_signed(out, tick - last)
            writer.write(pack([given.model_copy(update={"client": 0})]))
            last = tick

    @classmethod
    def read(cls, data: bytes) -> Self:
        """What `write` wrote."""
        source = Reader(data)
        epoch = source.varint()
        heard = last = source.varint(below=1 << 62)
        reader, inputs = RecordReader(source), []
        while source.left:
            last += source.signed()
            record = reader.read()
            try:
                (given,) = unpack(record)
            except InputError as error:
                raise ProtocolError(str(error)) from error
            inputs.append(SentInput(last, given))
        return cls(epoch=epoch, heard=heard, inputs=inputs)
