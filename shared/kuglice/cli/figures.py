"""Figures as a table for people or as JSON for programs: the same figures, on stdout."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from rich.console import Console
from rich.table import Table

from kuglice.cli.logs import STDERR

__all__ = ["Group", "print_figures", "print_groups"]

NAMES = frozenset({"epoch", "number"})
"""Numbers that name something and count nothing: their digits are not grouped."""


def print_figures(title: str, columns: Mapping[str, Mapping[str, Any]], *, as_json: bool) -> None:
    """`columns`: heading -> figure -> value. One column is printed (and dumped) without its heading."""
    if as_json:
        body: Any = next(iter(columns.values())) if len(columns) == 1 else columns
        print(json.dumps(body, indent=2, default=str))
        return
    table = Table(title=title, show_header=len(columns) > 1)
    table.add_column("")
    for heading in columns:
        table.add_column(heading, justify="right")
    columns = {heading: dict(_flat(column)) for heading, column in columns.items()}
    figures = dict.fromkeys(figure for column in columns.values() for figure in column)
    for figure in figures:
        table.add_row(
            figure.replace("_", " "), *(_shown(figure, column.get(figure, "")) for column in columns.values())
        )
    Console().print(table)


class Group(NamedTuple):
    """Figures that belong together; those of `troubles` are shown only if they are neither 0 nor missing."""

    figures: tuple[str, ...]
    troubles: tuple[str, ...] = ()


def print_groups(title: str, figures: Mapping[str, Any], groups: Mapping[str, Group]) -> None:
    """One column for people, heading by heading. What is in no group comes last."""
    flat = dict(_flat(figures))
    placed = {name for group in groups.values() for name in (*group.figures, *group.troubles)}
    rest = Group(tuple(name for name in figures if name not in placed))
    table = Table(title=title, show_header=False)
    for _ in range(2):
        table.add_column()
    table.add_column(justify="right")
    for heading, group in {**groups, "more": rest}.items():
        shown = [
            (figure, value)
            for name in (*group.figures, *group.troubles)
            for figure, value in flat.items()
            if figure.partition(" ")[0] == name and (value or name not in group.troubles)
        ]
        for place, (figure, value) in enumerate(shown):
            name = figure.removeprefix(f"{heading} ").replace("_", " ")
            table.add_row("" if place else heading, name, _shown(figure, value))
        table.add_section()
    Console().print(table)
    if any(group.troubles for group in groups.values()):
        STDERR.print(
            "What could have gone wrong and did not is left out; --json has every figure.", highlight=False
        )


def _flat(column: Mapping[str, Any], within: str = "") -> Iterator[tuple[str, Any]]:
    for figure, value in column.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{within}{figure} ")
        else:
            yield f"{within}{figure}", value


def _shown(figure: str, value: object) -> str:
    if figure in NAMES:
        return str(value)
    if value is None or value == []:
        return "-"
    if isinstance(value, float):
        return f"{value:,.3g}" if abs(value) < 1000 else f"{value:,.0f}"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list | tuple):
        return ", ".join(_shown(figure, one) for one in value)
    return f"{value:,}" if isinstance(value, int) else str(value)
