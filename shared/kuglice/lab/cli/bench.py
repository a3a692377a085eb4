"""`kuglice bench`: ns per ball-step."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer

from kuglice.cli.rows import print_rows
from kuglice.cli.writable import writable_folder
from kuglice.lab import bench as benches
from kuglice.lab.cli import capacity, network, wire
from kuglice.lab.cli.progress import progress
from kuglice.lab.machine import this_machine
from kuglice.lab.results import Results, write
from kuglice.lab.rows import rounded

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add the command; what else can be measured is a command under it."""
    group = typer.Typer(invoke_without_command=True)
    group.callback()(bench)
    capacity.register(group)
    network.register(group)
    wire.register(group)
    app.add_typer(group, name="bench")


def bench(  # noqa: PLR0917 - typer makes options of them
    context: typer.Context,
    peers: Annotated[
        bool,
        typer.Option(
            "--peers", help="Run all peers too; pymunk and the numba grid run in gas 10,000 in any case."
        ),
    ] = False,
    quick: Annotated[bool, typer.Option("--quick", help="Leave the largest scenes out.")] = False,
    repeats: Annotated[int, typer.Option(help="Rounds of every case.", min=1, max=1000)] = 5,
    only: Annotated[
        list[str] | None, typer.Option("--case", help="Only cases whose name contains this.")
    ] = None,
    out: Annotated[
        Path, typer.Option(callback=writable_folder, help="Where bench.json and bench.csv go.")
    ] = Path("out/bench"),
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Measure what ball-steps, copies and rollbacks cost.

    Peers run from the same initial state. In every round all contenders of a case take their turn, so
    that they meet the same noise. The table gives the minimum and the median of the rounds; `relative`
    compares minima with the first contender of the case. What the project wants to reach comes last, with
    a verdict on the minimum: met or missed.
    """
    if context.invoked_subcommand is not None:
        return
    results = Results(this_machine())
    chosen = [
        case
        for case in benches.cases(peers=peers, quick=quick, repeats=repeats)
        if not only or any(part in case.name for part in only)
    ]
    if not chosen:
        raise typer.BadParameter(f"no case is called like {', '.join(only or [])}", param_hint="--case")
    with progress(len(chosen)) as note:
        for case in chosen:
            note(case.name)
            results.rows += case.run()
            results.left_out += [f"{case.name}: without {reason}" for reason in case.left_out]
    verdicts, missing = benches.judged(results.rows)
    results.rows += verdicts
    if missing:
        results.left_out.append(f"targets without a figure in this run: {'; '.join(missing)}")
    written = write(results, out, "bench")
    if as_json:
        print(json.dumps(results.to_message(), indent=2))
    else:
        title = " | ".join(results.machine.lines())
        for rows in ([row for row in results.rows if "verdict" not in row], verdicts):
            if rows:
                print_rows(title, rounded(rows), as_json=False)
            title = "Targets"
    for line in [*results.left_out, *(f"wrote {path}" for path in written)]:
        print(line, file=sys.stderr)
