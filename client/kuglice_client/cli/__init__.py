"""Commands of the client, found through the entry point group "kuglice.commands"."""

from __future__ import annotations

import typer

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add them."""
    from kuglice_client.cli import client, render

    client.register(app)
    render.register(app)
