"""Who plays and what is held: what a view needs of others' inputs to run the very same step."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field

from kuglice import World
from kuglice.protocol.messages.envelope import U64, Message, TickNumber

__all__ = ["Holding"]

ClientNumber = Annotated[int, Field(ge=0, lt=1 << 32)]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Plays = Annotated[tuple[ClientNumber, U64 | None], Field(strict=False)]
Holds = Annotated[
    tuple[ClientNumber, Literal["thrust", "attract"], Finite, Finite, Finite], Field(strict=False)
]


class Holding(Message):
    """As `World.players` and `World.held` of state(`tick`)."""

    kind: ClassVar[str] = "holding"
    max_bytes: ClassVar[int] = 65_535

    tick: TickNumber
    players: list[Plays]
    held: list[Holds]

    @classmethod
    def of(cls, epoch: int, world: World) -> Self:
        """What a world says now."""
        return cls.model_validate(
            {"epoch": epoch, "tick": world.tick, "players": world.players, "held": world.held}
        )
