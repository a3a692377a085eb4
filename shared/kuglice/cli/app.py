"""The typer app, put together from the commands of all rooms."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from importlib.util import find_spec
from typing import Annotated, Any

import typer
from pydantic import ValidationError
from typer.core import TyperGroup

from kuglice.version import VERSION

__all__ = ["GROUP", "build"]

GROUP = "kuglice.commands"
"""Entry points: modules with `register(app)`."""
OWN = ("scenes", "plan", "replay", "demo", "router")
ORDER = (
    "demo",
    "scenes",
    "plan",
    "render",
    "server",
    "client",
    "view",
    "router",
    "replay",
    "study",
    "chart",
    "bench",
    "proxy",
)
"""Of the commands in --help: first to see what there is, then to use it, then to measure it. Others come last."""


HELP = """Colliding balls in the plane: bit-equal on every machine, interactive, and over a network.

A SCENE is a TOML file, or the name of a built-in scene with parameters if you like: gas, arena,
gas:n=2000,packing=0.5. `kuglice scenes` lists them.
"""


def build() -> typer.Typer:
    """All commands that are installed."""
    app = typer.Typer(
        cls=_Group,
        help=HELP,
        no_args_is_help=True,
        context_settings={"help_option_names": ["-h", "--help"]},
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
    )
    app.callback()(_options)
    for name in OWN:
        if find_spec(f"kuglice.cli.{name}") is not None:
            import_module(f"kuglice.cli.{name}").register(app)
    for entry in sorted(entry_points(group=GROUP), key=lambda entry: entry.name):
        _register(app, entry)
    return app


class _Group(TyperGroup):
    def list_commands(self, ctx: object) -> list[str]:
        """In our order, whoever registered them."""
        return sorted(self.commands, key=_place)

    def invoke(self, ctx: Any) -> object:  # noqa: ANN401 - typer hides its class
        """Whoever gave a value that is no good is told which one, also where typer tells the bound alone."""
        try:
            return super().invoke(ctx)
        except typer.BadParameter as error:
            if isinstance(error.__cause__, ValidationError):
                first = error.__cause__.errors()[0]
                error.message = f"{first['input']}: {first['msg'].replace('Input should', 'must')}"
            raise


def _place(name: str) -> int:
    return ORDER.index(name) if name in ORDER else len(ORDER)


def _register(app: typer.Typer, entry: EntryPoint) -> None:
    """A room that cannot be imported costs its own commands only."""
    try:
        entry.load().register(app)
    except ImportError as error:
        print(f"kuglice: the commands of {entry.value} are missing: {error}", file=sys.stderr)


def _show_version(wanted: bool) -> None:
    if wanted:
        print(f"kuglice {VERSION}")
        raise typer.Exit


def _options(
    version: Annotated[
        bool, typer.Option("--version", is_eager=True, callback=_show_version, help="Print the version.")
    ] = False,
) -> None:
    """Options of every command."""
