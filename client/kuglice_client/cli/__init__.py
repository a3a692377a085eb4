"""Commands of the client, found through the entry point group "kuglice.commands"."""

from __future__ import annotations

import typer

from kuglice_client.cli import client, render, study, view

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add them."""
    client.register(app)
    render.register(app)
    study.register(app)
    view.register(app)
