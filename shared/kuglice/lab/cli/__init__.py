"""Commands of the lab: `kuglice chart`, `kuglice bench` and `kuglice proxy`."""

from __future__ import annotations

import typer

from kuglice.lab.cli import bench, chart, proxy

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add them."""
    bench.register(app)
    chart.register(app)
    proxy.register(app)
