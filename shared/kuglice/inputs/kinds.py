"""The kinds of input: frozen schemas, told apart by `kind`."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from kuglice.errors import InputError
from kuglice.schema.numbers import NonNegative, Number, Positive, Whole
from kuglice.schema.problems import raises

__all__ = ["KINDS", "OWNER", "Attract", "Input", "Join", "Kick", "Leave", "Remove", "Spawn", "Thrust"]

OWNER = 0
"""The client number of the world's own scripts; players count from 1."""

Client = Annotated[Whole, Field(le=2**32 - 1)]
Sequence = Annotated[Whole, Field(le=2**64 - 1)]
BallId = Annotated[Whole, Field(le=2**64 - 2)]


class _Sent(BaseModel):
    """Inside a tick, inputs act in the order of client, then sequence."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    client: Client = OWNER
    sequence: Sequence = 0


@raises(InputError)
class Join(_Sent):
    """A client arrives; with a radius above 0 it gets a ball at (x, y)."""

    kind: Literal["join"] = "join"
    x: Number = 0.0
    y: Number = 0.0
    radius: NonNegative = 0.0
    mass: NonNegative = 0.0


@raises(InputError)
class Leave(_Sent):
    """A client goes, and its ball with it."""

    kind: Literal["leave"] = "leave"


@raises(InputError)
class Spawn(_Sent):
    """A new ball."""

    kind: Literal["spawn"] = "spawn"
    x: Number
    y: Number
    vx: Number = 0.0
    vy: Number = 0.0
    radius: Positive
    mass: Positive


@raises(InputError)
class Remove(_Sent):
    """The ball of this id goes."""

    kind: Literal["remove"] = "remove"
    ball: BallId


@raises(InputError)
class Thrust(_Sent):
    """A force on the client's own ball, held until changed."""

    kind: Literal["thrust"] = "thrust"
    x: Number
    y: Number


@raises(InputError)
class Attract(_Sent):
    """A point that attracts all balls, held until changed; strength 0 releases."""

    kind: Literal["attract"] = "attract"
    x: Number
    y: Number
    strength: Number


@raises(InputError)
class Kick(_Sent):
    """(vx, vy) is added to the velocity of a ball; None is the client's own."""

    kind: Literal["kick"] = "kick"
    ball: BallId | None = None
    vx: Number
    vy: Number


KINDS: tuple[type[_Sent], ...] = (Join, Leave, Spawn, Remove, Thrust, Attract, Kick)

Input = Annotated[
    Join | Leave | Spawn | Remove | Thrust | Attract | Kick,
    Field(discriminator="kind"),
]
