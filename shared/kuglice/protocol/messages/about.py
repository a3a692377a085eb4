"""What a client must know before it can step: joining starts here."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

from pydantic import Field

from kuglice.protocol.messages.envelope import Message, TickNumber

__all__ = ["About", "AboutWorld"]


class AboutWorld(Message):
    """Scene and model as their own modules put them into messages; clients never plan for themselves.

    `rate` is in ticks per second of wall clock; `step_version` changes when some state would step to other
    bits.
    """

    world: str
    version: str
    step_version: int
    scene: dict[str, Any]
    model: dict[str, Any]
    rate: Annotated[float, Field(gt=0, le=10_000)]
    tick: TickNumber


class About(AboutWorld):
    """For those who follow the whole world.

    Hashes are told of the states whose number is a multiple of `hash_every`.
    """

    kind: ClassVar[str] = "about"
    max_bytes: ClassVar[int] = 256 << 20

    snapshot_every: Annotated[int, Field(ge=1)]
    hash_every: Annotated[int, Field(ge=1)]
    history_ticks: Annotated[int, Field(ge=1)]
