"""The command line: `kuglice COMMAND`. Each room brings its own commands."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import NoReturn

from kuglice.aside import under_way
from kuglice.cli.interrupt import INTERRUPTED, end_on_interrupt, ended_by_interrupt
from kuglice.errors import KugliceError

__all__ = ["main"]

REFUSED = 2
"""Exit code for what a user can put right: the same as for a wrong option."""
FAILED = 1
"""Exit code of Python for a SystemExit with a text."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run one command. An error of this package is one line on stderr and exit code 2, never a traceback.

    Ctrl-C, where the command itself does not end in order on it, is exit code 130 and no word.

    With the `arguments` of the process (None) a command that is done ends the process, whatever Zenoh still does.
    """
    try:
        _run(arguments)
    except SystemExit as end:
        if arguments is None:
            if under_way():
                _leave(end)
            end_on_interrupt()
        raise


def _run(arguments: Sequence[str] | None) -> None:
    try:
        with ended_by_interrupt():
            from kuglice.cli.app import build  # noqa: PLC0415 - other rooms import this package for its parts

        build()(args=arguments, prog_name="kuglice")
    except KugliceError as error:
        print(f"kuglice: {error}", file=sys.stderr)
        raise SystemExit(REFUSED) from None
    except OSError as error:
        # A file that cannot be read or written, wherever it was named; anything else is a fault of ours.
        if error.filename is None:
            raise
        print(f"kuglice: {error.filename}: {error.strerror}", file=sys.stderr)
        raise SystemExit(REFUSED) from None
    except KeyboardInterrupt:
        raise SystemExit(INTERRUPTED) from None


def _leave(end: SystemExit) -> NoReturn:
    """What is not closed by now would be waited for: Zenoh's threads that answer are no daemons.

    As Python would end on it: a number is the status, None is 0, and anything else is told on stderr.
    """
    status = end.code
    if status is not None and not isinstance(status, int):
        print(status, file=sys.stderr)
        status = FAILED
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status or 0)
