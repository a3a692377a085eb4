"""A file that grows while somebody plays: what is there is replaced, unless another process still writes it."""

from __future__ import annotations

import os
import stat
import sys
from pathlib import Path
from typing import BinaryIO

from kuglice.errors import ReplayError

if sys.platform != "win32":
    import fcntl

__all__ = ["make_folder", "open_exclusive"]


def make_folder(path: Path) -> None:
    """The directory that is to hold `path`, if it is missing. Raises ReplayError if it cannot be made."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ReplayError(f"{path.parent}: cannot be made: {error.strerror}") from error


def open_exclusive(path: Path) -> BinaryIO:
    """`path`, empty, for writing by this process alone until it is closed.

    Raises ReplayError if it cannot be written, or if another does: then nothing of it is lost.
    """
    try:
        # To append does not empty: whose file it is must be known first.
        file = path.open("ab")
    except OSError as error:
        raise ReplayError(f"{path}: cannot be written: {error.strerror}") from error
    try:
        if stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            _lock(file)
            file.truncate(0)
    except BlockingIOError:
        file.close()
        raise ReplayError(
            f"{path}: cannot be written: a server or client that runs is writing it; end that one, or name another file"
        ) from None
    except OSError as error:
        file.close()
        raise ReplayError(f"{path}: cannot be written: {error.strerror}") from error
    return file


def _lock(file: BinaryIO) -> None:
    """Until it is closed, by a lock that ends with its process too. Raises BlockingIOError if another has it."""
    if sys.platform != "win32":
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise
        except OSError:
            # Some file systems over a network know no locks.
            return
