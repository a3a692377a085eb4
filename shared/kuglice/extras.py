"""Packages that only some users need, and one clear sentence where one is missing."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from kuglice.errors import MissingExtraError

__all__ = ["extra"]

DISTRIBUTIONS = {
    "PIL": "Pillow",
    "av": "PyAV",
    "matplotlib": "matplotlib",
    "numba": "numba",
    "pymunk": "pymunk",
    "scipy": "scipy",
}


@contextmanager
def extra(name: str) -> Iterator[None]:
    """Around imports of packages of an extra: `with extra("render"): import av`.

    Raises MissingExtraError, naming the package and the command that installs it.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        if module not in DISTRIBUTIONS:
            raise
        message = f"{DISTRIBUTIONS[module]} is not installed; it comes with: pip install 'kuglice[{name}]'"
        raise MissingExtraError(message, name=module) from error
