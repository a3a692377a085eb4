"""Commands of the server, found through the entry point group "kuglice.commands"."""

from __future__ import annotations

import typer

from kuglice_server.cli import server

__all__ = ["register"]


def register(app: typer.Typer) -> None:
    """Add them."""
    server.register(app)
