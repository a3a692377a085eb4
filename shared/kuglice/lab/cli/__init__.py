"""Commands of the lab: `kuglice chart` and `kuglice bench`."""

from __future__ import annotations

import typer

from kuglice.lab.cli import bench, chart

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add them."""
    bench.register(app)
    chart.register(app)
