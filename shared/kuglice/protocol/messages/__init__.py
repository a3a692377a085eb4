"""One file per kind of message."""

from kuglice.protocol.messages.about import About
from kuglice.protocol.messages.ack import Ack
from kuglice.protocol.messages.client_inputs import MAX_INPUTS, ClientInputs, SentInput
from kuglice.protocol.messages.envelope import PROTOCOL_VERSION, Message
from kuglice.protocol.messages.history import History
from kuglice.protocol.messages.part import PART_BYTES, Part
from kuglice.protocol.messages.refusal import Refusal
from kuglice.protocol.messages.request import SnapshotRequest, TickRange
from kuglice.protocol.messages.status import ClientStatus, Status
from kuglice.protocol.messages.stretch import Stretch, StretchedTick
from kuglice.protocol.messages.tick import MAX_TOLD_TICKS, Tick

__all__ = [
    "MAX_INPUTS",
    "MAX_TOLD_TICKS",
    "PART_BYTES",
    "PROTOCOL_VERSION",
    "About",
    "Ack",
    "ClientInputs",
    "ClientStatus",
    "History",
    "Message",
    "Part",
    "Refusal",
    "SentInput",
    "SnapshotRequest",
    "Status",
    "Stretch",
    "StretchedTick",
    "Tick",
    "TickRange",
]
