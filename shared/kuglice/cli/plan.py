"""`kuglice plan SCENE`: what would compute it, and why."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from kuglice.cli.pins import Broadphase, Contacts, Integrator, Substeps, pinned
from kuglice.planner import expect
from kuglice.planner import plan as choose
from kuglice.scenes import find

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("plan")(plan)


def plan(
    scene: Annotated[str, typer.Argument(help="A TOML file or a built-in scene.", metavar="SCENE")],
    *,
    integrator: Integrator = None,
    contacts: Contacts = None,
    substeps: Substeps = None,
    broadphase: Broadphase = None,
    as_json: Annotated[bool, typer.Option("--json", help="The same figures as JSON.")] = False,
) -> None:
    """Show the model that would compute a scene, and why.

    Every choice has a reason. A scene may pin parts of it in its table [model], and so may the options.
    """
    found = pinned(
        find(scene), integrator=integrator, contacts=contacts, substeps=substeps, broadphase=broadphase
    )
    model = choose(found)
    if as_json:
        expected = asdict(expect(found, model))
        figures = {"scene": scene, "balls": len(found.balls), **model.to_message(), "expected": expected}
        print(json.dumps(figures, indent=2))
        return
    table = Table(title=f"{found.title or scene}: {model}", title_justify="left", show_header=False)
    table.add_column(style="bold", no_wrap=True)
    table.add_column()
    for reason in model.reasons:
        table.add_row(*reason.split(": ", 1))
    Console().print(table)
