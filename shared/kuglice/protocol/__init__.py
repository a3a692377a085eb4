"""What goes over the wire: keys, messages, their bytes, large things in parts, and the Zenoh session.

Server and client both speak through this package and through nothing else.
"""

from kuglice.protocol.codec import decode, encode
from kuglice.protocol.compact import packed_size
from kuglice.protocol.endpoints import DEFAULT_ENDPOINT, is_loopback, wants_datagrams
from kuglice.protocol.exposure import refuse_exposed
from kuglice.protocol.keys import ANY_STATUS, Keys, check_name
from kuglice.protocol.messages import (
    MAX_INPUTS,
    MAX_REGION_BALLS,
    MAX_TOLD_TICKS,
    PACES,
    PART_BYTES,
    PROTOCOL_VERSION,
    About,
    Ack,
    ClientInputs,
    ClientStatus,
    History,
    Holding,
    Message,
    Part,
    Refusal,
    Region,
    RegionTerms,
    SentInput,
    SnapshotRequest,
    Status,
    Stretch,
    StretchedTick,
    Tick,
    TickRange,
    ViewAbout,
)
from kuglice.protocol.nodes import Nodes, Rectangle
from kuglice.protocol.parts import Assembly, Whole, split
from kuglice.protocol.session import (
    LEASE_MS,
    Declared,
    client_configuration,
    close_session,
    open_links,
    open_session,
    server_configuration,
)

__all__ = [
    "ANY_STATUS",
    "DEFAULT_ENDPOINT",
    "LEASE_MS",
    "MAX_INPUTS",
    "MAX_REGION_BALLS",
    "MAX_TOLD_TICKS",
    "PACES",
    "PART_BYTES",
    "PROTOCOL_VERSION",
    "About",
    "Ack",
    "Assembly",
    "ClientInputs",
    "ClientStatus",
    "Declared",
    "History",
    "Holding",
    "Keys",
    "Message",
    "Nodes",
    "Part",
    "Rectangle",
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
    "Whole",
    "check_name",
    "client_configuration",
    "close_session",
    "decode",
    "encode",
    "is_loopback",
    "open_links",
    "open_session",
    "packed_size",
    "refuse_exposed",
    "server_configuration",
    "split",
    "wants_datagrams",
]
