"""Where a command is to write: refused before anything is played or measured, and not after."""

from __future__ import annotations

import os
from pathlib import Path

import typer

__all__ = ["writable", "writable_file", "writable_folder"]


def writable(path: Path | None) -> Path | None:
    """For an option that names a file or a directory. Raises typer.BadParameter, and makes nothing."""
    if path is None:
        return None
    place = path
    while not os.path.exists(place) and place != place.parent:
        # What is missing is made later, in the nearest directory that is there.
        place = place.parent
    if place != path and not place.is_dir():
        raise typer.BadParameter(f"{path}: cannot be written: {place} is no directory")
    if not os.access(place, os.W_OK):
        raise typer.BadParameter(f"{path}: cannot be written: {place} must not be changed by you")
    return path


def writable_file(path: Path | None) -> Path | None:
    """For one that names a file. Raises typer.BadParameter, and makes nothing."""
    if path is not None and path.is_dir():
        raise typer.BadParameter(f"{path}: cannot be written: it is a directory, and must be a file")
    return writable(path)


def writable_folder(path: Path | None) -> Path | None:
    """For one that names a directory. Raises typer.BadParameter, and makes nothing."""
    if path is not None and path.exists() and not path.is_dir():
        raise typer.BadParameter(f"{path}: must be a directory, and is a file")
    return writable(path)
