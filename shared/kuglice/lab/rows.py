"""What is measured: rows of named values, kept as CSV beside each picture."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

__all__ = ["Row", "Rows", "Value", "read_csv", "rounded", "where", "write_csv"]

Value = str | int | float
Row = Mapping[str, Value]
Rows = Sequence[Row]


def write_csv(path: Path, rows: Rows, remarks: Iterable[str] = ()) -> None:
    """One line per row under a line of names; `remarks` come first, each behind a #."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    with path.open("w", newline="", encoding="utf-8") as file:
        for line in "\n".join(remarks).splitlines():
            file.write(f"# {line}\n")
        writer = csv.DictWriter(file, names, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_csv(path: Path) -> list[dict[str, Value]]:
    """The rows of a file that `write_csv` wrote; what reads as a number is one."""
    with path.open(newline="", encoding="utf-8") as file:
        lines = (line for line in file if not line.startswith("#"))
        return [
            {name: _value(text) for name, text in row.items() if text != ""} for row in csv.DictReader(lines)
        ]


def where(rows: Rows, **wanted: Value) -> list[Row]:
    """The rows that have all these values."""
    return [row for row in rows if all(row.get(name) == value for name, value in wanted.items())]


def rounded(rows: Rows, digits: int = 3) -> list[Row]:
    """The same rows for people: so many digits that count."""
    return [
        {
            name: float(f"{value:.{digits}g}") if isinstance(value, float) else value
            for name, value in row.items()
        }
        for row in rows
    ]


def _value(text: str) -> Value:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
