"""`kuglice bench wire`: bytes on the wire against the number of balls."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer

from kuglice.cli.rows import print_rows
from kuglice.cli.threads import Threads
from kuglice.cli.writable import writable_folder
from kuglice.errors import KugliceError
from kuglice.lab.cli.progress import progress
from kuglice.lab.machine import this_machine
from kuglice.lab.results import Results, write
from kuglice.lab.rows import rounded
from kuglice.lab.wire.measure import SCENES, jobs
from kuglice.scenes import find

__all__ = ["register"]

QUICK_SCENES = SCENES[:2]


def register(group: typer.Typer) -> None:
    """Add the command to `kuglice bench`."""
    group.command("wire")(wire)


def wire(
    *,
    quick: Annotated[bool, typer.Option("--quick", help="Only small scenes, for 2 s each.")] = False,
    scene: Annotated[list[str] | None, typer.Option(help="Only these scenes; may be repeated.")] = None,
    seconds: Annotated[float, typer.Option(help="Measured of each scene.", min=1.0, max=600.0)] = 10.0,
    threads: Threads = 1,
    out: Annotated[Path, typer.Option(callback=writable_folder, help="Where JSON and CSV go.")] = Path(
        "out/bench"
    ),
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Count bytes per ball, update and second.

    A real server of each scene, heard by a full client's subscription and by a view of about 1,000 balls in the
    middle. All bytes are payload, without what TCP and Zenoh wrap around it.
    """
    for one in scene or ():
        # Said before minutes are spent on the others.
        find(one)
    chosen = tuple(scene) if scene else QUICK_SCENES if quick else SCENES
    results = Results(this_machine())
    work = jobs(scenes=chosen, seconds=2.0 if quick else seconds, threads=threads)
    with progress(len(work)) as note:
        for job in work:
            note(job.label)
            try:
                results.rows += job.measure()
            except KugliceError as error:
                results.left_out.append(f"{job.label}: {error}")
    written = write(results, out, "wire")
    if as_json:
        print(json.dumps(results.to_message(), indent=2))
    else:
        print_rows(" | ".join(results.machine.lines()), rounded(results.rows), as_json=False)
    for line in [*results.left_out, *(f"wrote {path}" for path in written)]:
        print(line, file=sys.stderr)
