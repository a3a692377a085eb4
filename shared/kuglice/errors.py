"""Everything that this package raises on purpose.

KugliceError
├── SceneError (ValueError)   a scene that cannot be: key, value and bound of every problem found
├── ModelError (ValueError)   a method or a pairing of methods that is not registered
├── PlanError                 no model meets what a scene demands
├── InputError (ValueError)   an input that the scene refuses, or that is none
├── LimitError                more balls, ticks or bytes than a stated limit
├── SnapshotError             bytes that are no snapshot of such a world
├── LentError                 a change to a world whose arrays are lent
├── StepError                 a tick that cannot be made; the world stays at its last whole one
│   ├── DivergedError         a position or velocity that is no longer finite
│   ├── EventLimitError       more collisions, and sweeps of contacts at rest, in one tick than the limit
│   └── BudgetError           more work in one tick than the caller gave it
├── ReplayError               a replay or study file that is damaged, or not one
├── ProtocolError             a message that is damaged, too large, or of another version
├── NetworkError              a link that cannot be opened or conditioned as asked
├── JoinError                 a server that cannot be joined, or has dismissed the player
├── PictureError (ValueError) a picture or video that cannot be drawn or written as asked
└── MissingExtraError (ImportError)  a package that only an extra installs

The compiled core looks its errors up here by name.
"""

from __future__ import annotations

__all__ = [
    "BudgetError",
    "DivergedError",
    "EventLimitError",
    "InputError",
    "JoinError",
    "KugliceError",
    "LentError",
    "LimitError",
    "MissingExtraError",
    "ModelError",
    "NetworkError",
    "PictureError",
    "PlanError",
    "ProtocolError",
    "ReplayError",
    "SceneError",
    "SnapshotError",
    "StepError",
]


class KugliceError(Exception):
    """Root of the tree: catch it to catch everything that this package raises on purpose."""


class SceneError(KugliceError, ValueError):
    """A scene that cannot be. `problems` holds one sentence for each thing that is wrong."""

    def __init__(self, message: str, problems: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.problems = problems or (message,)


class ModelError(KugliceError, ValueError):
    """A method, or a pairing of methods, that is not registered."""


class PlanError(KugliceError):
    """No model meets what the scene demands."""


class InputError(KugliceError, ValueError):
    """An input that the scene refuses, or a message that is no input."""


class LimitError(KugliceError):
    """More balls, ticks or bytes than a stated limit allows."""


class SnapshotError(KugliceError):
    """Bytes that are no snapshot, a damaged one, or one of another version."""


class LentError(KugliceError):
    """A world was to change while its arrays were lent."""


class StepError(KugliceError):
    """A tick that cannot be made. The world stays as it was after its last whole tick."""


class DivergedError(StepError):
    """A position or velocity is no longer finite: the method is unstable in this scene."""


class EventLimitError(StepError):
    """A tick with more collisions than the limit.

    Sweeps over contacts at rest count as collisions, so that a dense pile that loses energy can reach it too.
    """


class BudgetError(StepError):
    """A tick that wanted more work than the caller gave it; with more it could be made."""


class ReplayError(KugliceError):
    """A replay or study file that is damaged, or none at all."""


class ProtocolError(KugliceError):
    """A message that is damaged, too large, or of another version."""


class NetworkError(KugliceError):
    """A link that cannot be opened, or not be conditioned as asked."""


class JoinError(KugliceError):
    """A server that cannot be joined, or that will have a player no more."""


class PictureError(KugliceError, ValueError):
    """A picture or a video that cannot be drawn or written as asked."""


class MissingExtraError(KugliceError, ImportError):
    """A package that only an extra of this distribution installs."""
