"""`kuglice bench network`: what a bad network does to a game."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer

from kuglice.cli.writable import writable_folder
from kuglice.errors import KugliceError
from kuglice.lab.cli.progress import progress
from kuglice.lab.machine import this_machine
from kuglice.lab.network.cell import Cell
from kuglice.lab.network.conditioner import LINKS
from kuglice.lab.network.markdown import markdown
from kuglice.lab.network.table import cells, snapshot_cells
from kuglice.lab.network.tun_device import why_impossible
from kuglice.lab.results import Results, write

__all__ = ["register"]


def register(group: typer.Typer) -> None:
    """Add the command to `kuglice bench`."""
    group.command("network")(network)


def network(
    *,
    quick: Annotated[
        bool, typer.Option("--quick", help="Only 150 ms with jitter and loss, small scenes.")
    ] = False,
    seconds: Annotated[
        float, typer.Option(help="Of play in each cell; the cut comes on top.", min=1.0, max=3600.0)
    ] = 10.0,
    only: Annotated[
        list[str] | None, typer.Option("--scene", help="Only scenes whose name contains this.")
    ] = None,
    link: Annotated[
        str, typer.Option(help="tunnel (real packets; needs root), proxy, or auto: a tunnel if possible.")
    ] = "auto",
    cut_everywhere: Annotated[
        bool, typer.Option("--cut-everywhere", help="Cut the link in every cell, not only at 150 ms.")
    ] = False,
    snapshots: Annotated[
        bool, typer.Option("--snapshots", help="Vary the rate of snapshots instead of the link.")
    ] = False,
    out: Annotated[
        Path, typer.Option(callback=writable_folder, help="Where JSON, CSV and Markdown go.")
    ] = Path("out/bench"),
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Measure what players see over delay, jitter, loss and cuts.

    A real server and real clients, each a process, with a conditioned link between them: every scene, at round
    trips of 0, 50, 150 and 300 ms, without and with 20 % jitter, with 2 % of the packets lost each way. At 150
    ms with jitter the link is then cut for 5 s. Under half a minute per cell.
    """
    if link not in LINKS:
        raise typer.BadParameter(f"link {link!r}: must be one of {', '.join(LINKS)}", param_hint="--link")
    if link == "auto" and (reason := why_impossible()) is not None:
        print(f"no tunnel, so a proxy: {reason}; bytes on the wire are not measured", file=sys.stderr)
    chosen = (
        snapshot_cells(seconds=seconds, link=link)
        if snapshots
        else cells(quick=quick, seconds=seconds, link=link, cut_everywhere=cut_everywhere, only=only or ())
    )
    if not chosen:
        raise typer.BadParameter(f"no scene is called like {', '.join(only or [])}", param_hint="--scene")
    results = Results(this_machine())
    name = "snapshots" if snapshots else "network"
    with progress(len(chosen)) as note:
        for cell in chosen:
            note(cell.label)
            _measure(cell, results)
            # After each, for whoever has to stop it after an hour.
            written = write(results, out, name)
    table = out / f"{name}.md"
    table.write_text(markdown(results.rows), encoding="utf-8")
    print(json.dumps(results.to_message(), indent=2) if as_json else markdown(results.rows))
    for line in [*results.left_out, *(f"wrote {path}" for path in [*written, table])]:
        print(line, file=sys.stderr)


def _measure(cell: Cell, results: Results) -> None:
    try:
        results.rows += cell.measure()
    except KugliceError as error:
        # One game that cannot be played is a finding too, and no reason to lose the others.
        results.left_out.append(f"{cell.label}: {error}")
