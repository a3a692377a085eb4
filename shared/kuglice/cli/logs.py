"""Logs of the commands: to stderr, since stdout is for data."""

from __future__ import annotations

import logging

from rich.console import Console
from rich.logging import RichHandler

__all__ = ["STDERR", "log_to_stderr"]

STDERR = Console(stderr=True)


def log_to_stderr(*, quiet: bool = False) -> None:
    """Send the logs of all rooms to stderr; `quiet` leaves warnings and errors."""
    handler = RichHandler(console=STDERR, show_path=False, rich_tracebacks=False, log_time_format="%H:%M:%S")
    logging.basicConfig(
        level=logging.WARNING if quiet else logging.INFO, format="%(message)s", handlers=[handler]
    )
