"""Packages that only some users need, and one clear sentence where one is missing."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module

from kuglice.errors import MissingExtraError

__all__ = ["extra", "require"]

DISTRIBUTIONS = {
    "PIL": "Pillow",
    "av": "PyAV",
    "matplotlib": "matplotlib",
    "numba": "numba",
    "pymunk": "pymunk",
    "scipy": "scipy",
}


MODULES = {"render": ("PIL", "av")}
"""What an extra brings, where a command wants all of it from the start."""


def require(name: str) -> None:
    """Raises MissingExtraError unless the packages of an extra are installed: before work, not after it."""
    with extra(name):
        for module in MODULES[name]:
            import_module(module)


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
