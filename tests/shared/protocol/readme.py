"""The protocol's README, taken apart."""

from __future__ import annotations

import re
from pathlib import Path

import kuglice.protocol

__all__ = ["PROSE", "TEXT", "table", "vectors"]

TEXT = (Path(kuglice.protocol.__file__).parent / "README.md").read_text()
PROSE = " ".join(TEXT.split())
"""Wherever its lines end."""


def table(*columns: str) -> list[list[str]]:
    """Rows of the only table that has these columns, without the backticks of cells that are one word."""
    head = f"| {' | '.join(columns)} |\n"
    assert TEXT.count(head) == 1, head
    rows = TEXT.partition(head)[2].partition("\n\n")[0].splitlines()[1:]
    split = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]
    assert all(len(row) == len(columns) for row in split)
    return [[re.sub(r"^`([^`]*)`$", r"\1", cell) for cell in row] for row in split]


def vectors() -> list[tuple[str, str, bytes]]:
    """For each: what is to be done before, the expression of the message, its bytes."""
    (block,) = re.findall(r"^```python\n(.*?)^```$", TEXT, re.DOTALL | re.MULTILINE)
    found = []
    for paragraph in block.strip().split("\n\n"):
        lines = [line.partition("#")[0].strip() for line in paragraph.splitlines()]
        is_hex = [re.fullmatch(r"([0-9a-f]{2} ?)+", line) is not None for line in lines]
        first = is_hex.index(True)
        assert all(is_hex[first:]), paragraph
        found.append(
            ("\n".join(lines[: first - 1]), lines[first - 1], bytes.fromhex(" ".join(lines[first:])))
        )
    return found
