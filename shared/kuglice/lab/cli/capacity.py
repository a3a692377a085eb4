"""`kuglice bench capacity`: how many clients one server feeds."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer

from kuglice.cli.rows import print_rows
from kuglice.lab.capacity.measure import LADDER, ROUTERS, jobs
from kuglice.lab.cli.progress import progress
from kuglice.lab.jobs import done
from kuglice.lab.machine import this_machine
from kuglice.lab.results import Results, write
from kuglice.lab.rows import rounded

__all__ = ["register"]


def register(group: typer.Typer) -> None:
    """Add the command to `kuglice bench`."""
    group.command("capacity")(capacity)


def capacity(
    *,
    quick: Annotated[bool, typer.Option("--quick", help="Only the first rungs, and 2 s each.")] = False,
    seconds: Annotated[float, typer.Option(help="Measured on each rung.", min=1.0, max=600.0)] = 5.0,
    routers: Annotated[
        list[int] | None, typer.Option(help="Routers to put before the clients: 0, 1 or 2. [default: each]")
    ] = None,
    out: Annotated[Path, typer.Option(help="Where JSON and CSV go.")] = Path("out/bench"),
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Feed more and more clients until a tick is late.

    Server, routers, two players and all listeners share this machine; the listeners, which are real sessions
    that decode every message, step aside for the server. A row is a rung of the ladder, and a ladder ends at
    the first rung on which a tick was late or a listener missed one.
    """
    wanted = tuple(sorted(set(routers))) if routers else ROUTERS
    if any(number not in ROUTERS for number in wanted):
        raise typer.BadParameter(
            f"routers {list(wanted)}: must be among {list(ROUTERS)}", param_hint="--routers"
        )
    work = jobs(routers=wanted, ladder=LADDER[:3] if quick else LADDER, seconds=2.0 if quick else seconds)
    results = Results(this_machine())
    with progress(len(work)) as note:
        results.rows += done(work, note)
    written = write(results, out, "capacity")
    if as_json:
        print(json.dumps(results.to_message(), indent=2))
    else:
        print_rows(" | ".join(results.machine.lines()), rounded(results.rows), as_json=False)
    for path in written:
        print(f"wrote {path}", file=sys.stderr)
