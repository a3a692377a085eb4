"""The figures of one run of a bench: JSON and CSV, each with the machine."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from kuglice.lab.machine import Machine
from kuglice.lab.rows import Row, write_csv

__all__ = ["Results", "write"]


@dataclass
class Results:
    """Rows of all cases; what was left out, with reasons."""

    machine: Machine
    rows: list[Row] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)

    def to_message(self) -> dict[str, Any]:
        """Values that JSON knows."""
        return {
            "machine": self.machine.to_message(),
            "rows": [dict(row) for row in self.rows],
            "left_out": self.left_out,
        }


def write(results: Results, directory: Path, name: str) -> list[Path]:
    """`name`.json and `name`.csv; their paths."""
    directory.mkdir(parents=True, exist_ok=True)
    as_json, as_csv = directory / f"{name}.json", directory / f"{name}.csv"
    as_json.write_text(json.dumps(results.to_message(), indent=2) + "\n", encoding="utf-8")
    write_csv(as_csv, results.rows, [*results.machine.lines(), *results.left_out])
    return [as_json, as_csv]
