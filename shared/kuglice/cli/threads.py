"""The option by which a command takes a number of threads."""

from __future__ import annotations

from typing import Annotated

import typer

from kuglice import _core

__all__ = ["Threads"]

Threads = Annotated[
    int, typer.Option(help="Threads that share the work of a step; same bits.", min=1, max=_core.MOST_THREADS)
]
