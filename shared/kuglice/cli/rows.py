"""Rows as a table for people or as JSON for programs: the same figures, on stdout."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.measure import Measurement
from rich.table import Table

__all__ = ["print_rows"]

WIDE = 160
"""Columns for a reader that is no terminal, and so has no width."""
UNBOUNDED = 1_000_000


def print_rows(title: str, rows: Sequence[Mapping[str, Any]], *, as_json: bool) -> None:
    """Each row: heading -> value, the same headings in all. Numbers and names are printed in full: what is too wide for
    the terminal has its rows side by side, as many as there is room for, and then the next.
    """
    if as_json:
        print(json.dumps(list(rows), indent=2))
        return
    if not rows:
        print(f"{title}: nothing was measured", file=sys.stderr)
        return
    console = Console(width=None if sys.stdout.isatty() else WIDE)
    table = _upright(title, rows)
    if _fits(table, console):
        console.print(table)
        return
    first = 0
    while first < len(rows):
        end = first + 1
        while end < len(rows) and _fits(_turned("", rows[first : end + 1]), console):
            end += 1
        console.print(_turned(title if first == 0 else "", rows[first:end]))
        first = end


def _fits(table: Table, console: Console) -> bool:
    return (
        Measurement.get(console, console.options.update(max_width=UNBOUNDED), table).minimum <= console.width
    )


def _upright(title: str, rows: Sequence[Mapping[str, Any]]) -> Table:
    table = Table(title=title, title_justify="left", header_style="bold")
    for heading, value in rows[0].items():
        number = isinstance(value, int | float)
        # Text wraps instead: half a name is no name.
        table.add_column(heading, justify="right" if number else "left", overflow="fold", no_wrap=number)
    for row in rows:
        table.add_row(*map(_shown, row.values()))
    return table


def _turned(title: str, rows: Sequence[Mapping[str, Any]]) -> Table:
    table = Table(title=title, title_justify="left", show_header=False)
    table.add_column(style="bold", no_wrap=True)
    for _ in rows:
        table.add_column(justify="right", no_wrap=True)
    for heading in rows[0]:
        table.add_row(heading, *(_shown(row[heading]) for row in rows))
    return table


def _shown(value: object) -> str:
    if value is None:
        return "-"
    return f"{value:,}" if isinstance(value, int) else str(value)
