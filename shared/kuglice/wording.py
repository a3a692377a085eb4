"""Words for numbers of things, as they are told to people."""

from __future__ import annotations

__all__ = ["of_many"]


def of_many(count: int, thing: str) -> str:
    """`thing`, as it is called where there are `count` of it: ball, balls."""
    return thing if count == 1 else f"{thing}s"
