"""What a conditioner process is told on stdin and answers on stdout: one JSON value per line.

    {"change": CONDITIONS}   {"cut": seconds}   {"stall": seconds}   {"mend": true}   {"count": true}

Each is answered with the counters so far. At the end of stdin the process ends, so that it never outlives
whoever started it.
"""

from __future__ import annotations

import asyncio
import json
import sys
from collections import Counter
from collections.abc import Callable, Sequence

from kuglice.errors import NetworkError
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.interruption import Interruption
from kuglice.lab.network.line import Line

__all__ = ["obey", "say"]


def say(**message: object) -> None:
    """One line on stdout, at once."""
    print(json.dumps(message), flush=True)


async def obey(
    lines: Sequence[Line], counter: Counter[str], interrupt: Callable[[Interruption], object]
) -> None:
    """Do what stdin says until it ends; `interrupt` does so to the lines, now, and to what hangs on them."""
    loop = asyncio.get_running_loop()
    reader = asyncio.StreamReader()
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), sys.stdin)
    while text := await reader.readline():
        try:
            _do(json.loads(text), lines, interrupt)
        except (NetworkError, ValueError) as error:
            say(error=str(error))
        else:
            say(counts=dict(counter))


def _do(order: object, lines: Sequence[Line], interrupt: Callable[[Interruption], object]) -> None:
    if not isinstance(order, dict) or len(order) != 1:
        raise NetworkError(f"order {order!r}: must be an object with one key")
    ((name, value),) = order.items()
    match name:
        case "change" if isinstance(value, dict):
            conditions = Conditions.from_message(value)
            for line in lines:
                line.change(conditions)
        case "cut" | "stall" if isinstance(value, int | float):
            interrupt(Interruption(name, value))
        case "mend":
            for line in lines:
                line.mend()
        case "count":
            pass
        case _:
            raise NetworkError(
                f"order {order!r}: must be change with conditions, cut or stall with seconds, mend, or count"
            )
