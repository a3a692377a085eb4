"""The typer app, put together from the commands of all rooms."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from kuglice.cli.interrupt import ended_by_interrupt
from kuglice.version import VERSION

__all__ = ["GROUP", "build"]

GROUP = "kuglice.commands"
"""Entry points: modules with `register(app)`, one for each room."""
OWN = "kuglice.cli"
COMMANDS = {
    "demo": OWN,
    "scenes": OWN,
    "plan": OWN,
    "render": "client",
    "server": "server",
    "client": "client",
    "view": "client",
    "router": OWN,
    "replay": OWN,
    "study": "client",
    "chart": "lab",
    "bench": "lab",
    "proxy": "lab",
}
"""The room of each command, the only one that is imported for it. In --help they come in this order: first to see
what there is, then to use it, then to measure it. Those of rooms that are not named here come last."""


HELP = """Colliding balls in the plane: bit-equal on every machine, interactive, and over a network.

A SCENE is a TOML file, or the name of a built-in scene with parameters if you like: gas, arena,
gas:n=2000,packing=0.5. `kuglice scenes` lists them.

What cannot be done is said in one line, and ends with status 2.
"""


def build() -> typer.Typer:
    """All commands that are installed, each imported when it is asked for."""
    app = typer.Typer(
        cls=_Group,
        help=HELP,
        no_args_is_help=True,
        context_settings={"help_option_names": ["-h", "--help"]},
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
    )
    app.callback()(_options)
    return app


class _Group(TyperGroup):
    def list_commands(self, ctx: object) -> list[str]:
        """In our order, whoever registered them."""
        self._import(COMMANDS, entry_points(group=GROUP))
        return sorted(self.commands, key=_place)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:  # noqa: ANN401 - typer hides its classes
        """The command, imported; for a name that nobody knows all are, so that typer can say which is like it."""
        if cmd_name not in self.commands:
            room = COMMANDS.get(cmd_name)
            of_room = [entry for entry in entry_points(group=GROUP) if room in {None, entry.name}]
            self._import([cmd_name] if room is not None else COMMANDS, of_room)
        return super().get_command(ctx, cmd_name)

    def invoke(self, ctx: Any) -> object:  # noqa: ANN401 - typer hides its class
        """Whoever gave a value that is no good is told which one, also where typer tells the bound alone."""
        try:
            return super().invoke(ctx)
        except typer.BadParameter as error:
            from pydantic import ValidationError  # noqa: PLC0415 - too much for `kuglice --version`

            if isinstance(error.__cause__, ValidationError):
                first = error.__cause__.errors()[0]
                error.message = f"{first['input']}: {first['msg'].replace('Input should', 'must')}"
            raise

    def _import(self, names: Iterable[str], entries: Iterable[EntryPoint]) -> None:
        """Those of `names` that are our own, and all of the rooms at `entries`."""
        app = typer.Typer(context_settings={"help_option_names": ["-h", "--help"]}, rich_markup_mode=None)
        app.callback()(_options)
        with ended_by_interrupt():
            for name in names:
                if COMMANDS.get(name) == OWN:
                    import_module(f"{OWN}.{name}").register(app)
            for entry in sorted(entries, key=lambda entry: entry.name):
                _register(app, entry)
        for name, command in typer.main.get_group(app).commands.items():
            self.commands.setdefault(name, command)


def _place(name: str) -> int:
    return list(COMMANDS).index(name) if name in COMMANDS else len(COMMANDS)


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
