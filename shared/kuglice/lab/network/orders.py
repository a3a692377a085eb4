"""What a conditioner process is told on stdin and answers on stdout: one JSON value per line.

    {"change": CONDITIONS}   {"cut": seconds}   {"stall": seconds}   {"count": true}

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
from kuglice.lab.network.line import Line

__all__ = ["obey", "say"]

LONGEST_SECONDS = 3600.0


def say(**message: object) -> None:
    """One line on stdout, at once."""
    print(json.dumps(message), flush=True)


async def obey(
    lines: Sequence[Line], counter: Counter[str], when_cut: Callable[[], None] = lambda: None
) -> None:
    """Do what stdin says until it ends; `when_cut` is called when the lines have been cut."""
    loop = asyncio.get_running_loop()
    reader = asyncio.StreamReader()
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), sys.stdin)
    while text := await reader.readline():
        try:
            if _do(json.loads(text), lines, loop.time()) == "cut":
                when_cut()
        except (NetworkError, ValueError) as error:
            say(error=str(error))
        else:
            say(counts=dict(counter))


def _do(order: object, lines: Sequence[Line], now: float) -> str:
    if not isinstance(order, dict) or len(order) != 1:
        raise NetworkError(f"order {order!r}: must be an object with one key")
    ((name, value),) = order.items()
    match name:
        case "change" if isinstance(value, dict):
            conditions = Conditions.from_message(value)
            for line in lines:
                line.change(conditions)
        case "cut" | "stall" if isinstance(value, int | float) and 0 <= value <= LONGEST_SECONDS:
            for line in lines:
                getattr(line, name)(now + value)
        case "count":
            pass
        case _:
            raise NetworkError(
                f"order {order!r}: must be change with conditions, cut or stall with 0 to "
                f"{LONGEST_SECONDS:g} seconds, or count"
            )
    return str(name)
