"""One file per kind of message."""

from kuglice.protocol.messages.about import About
from kuglice.protocol.messages.ack import Ack
from kuglice.protocol.messages.admission import Admission
from kuglice.protocol.messages.client_inputs import MAX_INPUTS, ClientInputs, SentInput
from kuglice.protocol.messages.envelope import MAX_WHOLE_BYTES, PROTOCOL_VERSION, Message
from kuglice.protocol.messages.history import History
from kuglice.protocol.messages.holding import Holding
from kuglice.protocol.messages.part import PART_BYTES, Part
from kuglice.protocol.messages.refusal import Refusal
from kuglice.protocol.messages.region import MAX_REGION_BALLS, Region
from kuglice.protocol.messages.request import ANY_EPOCH, ArrivalRequest, SnapshotRequest, TickRange
from kuglice.protocol.messages.status import ClientStatus, Status
from kuglice.protocol.messages.stretch import Stretch, StretchedTick
from kuglice.protocol.messages.tick import MAX_TOLD_TICKS, Tick
from kuglice.protocol.messages.view_about import PACES, RegionTerms, ViewAbout

__all__ = [
    "ANY_EPOCH",
    "MAX_INPUTS",
    "MAX_REGION_BALLS",
    "MAX_TOLD_TICKS",
    "MAX_WHOLE_BYTES",
    "PACES",
    "PART_BYTES",
    "PROTOCOL_VERSION",
    "About",
    "Ack",
    "Admission",
    "ArrivalRequest",
    "ClientInputs",
    "ClientStatus",
    "History",
    "Holding",
    "Message",
    "Part",
    "Refusal",
    "Region",
    "RegionTerms",
    "SentInput",
    "SnapshotRequest",
    "Status",
    "Stretch",
    "StretchedTick",
    "Tick",
    "TickRange",
    "ViewAbout",
]
