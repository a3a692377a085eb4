"""`kuglice bench capacity`: how many clients one server feeds."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer

from kuglice.cli.rows import print_rows
from kuglice.cli.writable import writable_folder
from kuglice.lab.capacity.measure import KINDS, LADDER, ROUTERS, jobs
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
    kind: Annotated[
        list[str] | None, typer.Option(help="What listens: client or view. [default: each]")
    ] = None,
    out: Annotated[Path, typer.Option(callback=writable_folder, help="Where JSON and CSV go.")] = Path(
        "out/bench"
    ),
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Feed more and more clients until a tick is late.

    Full clients hear the ticks of an arena that two players stir; views hear 16 of the 256 regions of a gas of
    10,000 balls each, ten times per second. All of them share this machine with server and routers; they are
    real sessions that decode every message, and step aside for the server. A row is a rung of the ladder, and a
    ladder ends at the first rung on which a tick was late or a listener missed a message.
    """
    wanted = tuple(sorted(set(routers))) if routers else ROUTERS
    if any(number not in ROUTERS for number in wanted):
        raise typer.BadParameter(
            f"routers {list(wanted)}: must be among {list(ROUTERS)}", param_hint="--routers"
        )
    kinds = tuple(dict.fromkeys(kind)) if kind else KINDS
    if any(each not in KINDS for each in kinds):
        raise typer.BadParameter(f"kind {list(kinds)}: must be among {list(KINDS)}", param_hint="--kind")
    work = jobs(
        routers=wanted,
        ladder=LADDER[:3] if quick else LADDER,
        seconds=2.0 if quick else seconds,
        kinds=kinds,
    )
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
