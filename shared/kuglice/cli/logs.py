"""Logs of the commands: to stderr, since stdout is for data."""

from __future__ import annotations

import logging

from rich.console import Console
from rich.logging import RichHandler

__all__ = ["STDERR", "log_to_stderr"]

STDERR = Console(stderr=True, soft_wrap=True)


def log_to_stderr(*, quiet: bool = False) -> None:
    """Send the logs of all rooms to stderr; `quiet` leaves warnings and errors.

    A terminal gets colours; a file gets one plain line per message.
    """
    level = logging.WARNING if quiet else logging.INFO
    if STDERR.is_terminal:
        handler: logging.Handler = RichHandler(console=STDERR, show_path=False, log_time_format="%H:%M:%S")
        logging.basicConfig(level=level, format="%(message)s", handlers=[handler])
    else:
        logging.basicConfig(level=level, format="%(asctime)s %(levelname)-7s %(message)s")
