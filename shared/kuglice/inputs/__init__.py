"""What acts on a world from outside: seven kinds of input, their records, messages and bounds."""

from kuglice.inputs.bounds import check
from kuglice.inputs.joining import join
from kuglice.inputs.kinds import KINDS, OWNER, Attract, Input, Join, Kick, Leave, Remove, Spawn, Thrust
from kuglice.inputs.message import from_message, to_message
from kuglice.inputs.record import pack, unpack
from kuglice.inputs.rounding import rounded

__all__ = [
    "KINDS",
    "OWNER",
    "Attract",
    "Input",
    "Join",
    "Kick",
    "Leave",
    "Remove",
    "Spawn",
    "Thrust",
    "check",
    "from_message",
    "join",
    "pack",
    "rounded",
    "to_message",
    "unpack",
]
