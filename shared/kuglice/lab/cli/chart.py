"""`kuglice chart`: all figures of the lab, each rebuilt from nothing."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kuglice.cli.writable import writable_file, writable_folder
from kuglice.lab.cli.progress import progress
from kuglice.lab.jobs import Effort, done
from kuglice.lab.machine import this_machine
from kuglice.lab.rows import Rows, write_csv
from kuglice.scenes import find

if TYPE_CHECKING:
    from kuglice.lab.charts import Chart

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("chart")(chart)


def chart(  # noqa: PLR0917 - typer makes options of them
    scene: Annotated[
        str | None, typer.Argument(help="Only the work-precision diagram of this scene.", metavar="[SCENE]")
    ] = None,
    peers: Annotated[
        bool, typer.Option("--peers/--no-peers", help="Draw peers into the same charts.")
    ] = True,
    quick: Annotated[bool, typer.Option("--quick", help="Less of everything, in under a minute.")] = False,
    only: Annotated[list[str] | None, typer.Option(help="Only charts whose name contains this.")] = None,
    repeats: Annotated[int, typer.Option(help="Rounds of every timing.", min=1, max=100)] = 5,
    out: Annotated[Path, typer.Option(callback=writable_folder, help="Where PNG, SVG and CSV go.")] = Path(
        "out/chart"
    ),
    plan_table: Annotated[
        Path | None,
        typer.Option(
            callback=writable_file, help="Write the planner's table here too, as `make chart` does."
        ),
    ] = None,
) -> None:
    """Measure and draw the charts of precision and cost.

    Work against precision, growth of cost, stability, loops, and the planner's table. Each chart is a
    PNG, an SVG, and the CSV that it was drawn from. What a method cannot run is named on stderr with the
    reason.
    """
    # Here, because matplotlib takes a second and may be missing.
    from kuglice.lab.charts import charts, scene_chart  # noqa: PLC0415
    from kuglice.lab.work_precision import subject  # noqa: PLC0415

    effort = Effort(quick=quick, peers=peers, repeats=min(repeats, 3) if quick else repeats)
    if scene is not None:
        chosen = [scene_chart(scene.partition(":")[0].replace("/", "_"), subject(find(scene)))]
    else:
        every = charts()
        chosen = [each for each in every if not only or any(part in each.name for part in only)]
        if not chosen:
            names = ", ".join(each.name for each in every)
            raise typer.BadParameter(
                f"no chart is called like {', '.join(only or [])}, only {names}", param_hint="--only"
            )
    for path in _make(chosen, effort, out, plan_table):
        print(path)


def _make(chosen: list[Chart], effort: Effort, out: Path, plan_table: Path | None) -> list[Path]:
    out.mkdir(parents=True, exist_ok=True)
    left_out: list[str] = []
    work = [(each, each.jobs(effort, left_out)) for each in chosen]
    written: list[Path] = []
    with progress(sum(len(jobs) for _, jobs in work)) as note:
        for each, jobs in work:
            rows = done(jobs, note)
            written += _write(each, rows, effort, out)
            if each.name == "planner" and plan_table is not None:
                written.append(_write_table(plan_table, rows))
    for line in left_out:
        print(f"left out: {line}", file=sys.stderr)
    return written


def _write(each: Chart, rows: Rows, effort: Effort, out: Path) -> list[Path]:
    from kuglice.lab.figures.look import look  # noqa: PLC0415
    from kuglice.lab.figures.sheet import save  # noqa: PLC0415

    seeds = sorted({str(row["seeds"]) for row in rows if "seeds" in row}, key=len)
    said = f"seeds {seeds[-1]}; " if seeds else ""
    remarks = [*this_machine().lines(), f"{said}times: minimum of {effort.repeats} repeats"]
    remarks[-1] += "; quick run" if effort.quick else ""
    table = out / f"{each.name}.csv"
    write_csv(table, rows, remarks)
    with look():
        return [*save(each.draw(rows), out / each.name, remarks), table]


def _write_table(path: Path, rows: Rows) -> Path:
    write_csv(path, rows, this_machine().lines())
    return path
