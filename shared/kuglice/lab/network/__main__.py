"""The process of a conditioned link: `python -m kuglice.lab.network proxy LISTEN TARGET`, or `... tunnel`.

Conditions, and all that follows, come on stdin (orders.py). People use `kuglice proxy`.
"""

from __future__ import annotations

import asyncio
import sys

from kuglice.errors import NetworkError
from kuglice.lab.network.addresses import address
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.orders import obey, say
from kuglice.lab.network.proxy import Proxy
from kuglice.lab.network.tunnel import run_tunnel


def main(arguments: list[str]) -> None:
    """Begin without conditions: the first order brings them."""
    match arguments:
        case ["proxy", listen, target]:
            asyncio.run(_proxy(Proxy(address(listen), address(target), Conditions())))
        case ["tunnel"]:
            run_tunnel(Conditions())
        case _:
            raise NetworkError(f"arguments {arguments}: must be proxy LISTEN TARGET, or tunnel")


async def _proxy(proxy: Proxy) -> None:
    await proxy.start()
    say(ready=True)
    await obey(proxy.lines, proxy.counter, proxy.interrupt)
    proxy.close()


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except NetworkError as error:
        sys.exit(str(error))
