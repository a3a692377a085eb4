"""Rows as a table for people or as JSON for programs: the same figures, on stdout."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table

__all__ = ["print_rows"]

WIDE = 160
"""Columns for a reader that is no terminal, and so has no width."""


def print_rows(title: str, rows: Sequence[Mapping[str, Any]], *, as_json: bool) -> None:
    """Each row: heading -> value. Numbers are printed in full."""
    if as_json:
        print(json.dumps(list(rows), indent=2))
        return
    if not rows:
        print(f"{title}: nothing was measured", file=sys.stderr)
        return
    table = Table(title=title, title_justify="left", header_style="bold")
    for heading, value in rows[0].items():
        number = isinstance(value, int | float)
        # Text wraps instead: half a name is no name.
        table.add_column(heading, justify="right" if number else "left", overflow="fold", no_wrap=number)
    for row in rows:
        table.add_row(*map(_shown, row.values()))
    Console(width=None if sys.stdout.isatty() else WIDE).print(table)


def _shown(value: object) -> str:
    if value is None:
        return "-"
    return f"{value:,}" if isinstance(value, int) else str(value)
