"""The end of a film, whatever the play came to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kuglice.cli.logs import STDERR
from kuglice.errors import KugliceError

if TYPE_CHECKING:
    from kuglice_client.filming import Film

__all__ = ["finished"]

FINISH_SECONDS = 600.0


def finished(film: Film) -> dict[str, Any]:
    """Waits for the film; its figures, and under `film_error` why there is none."""
    figures: dict[str, Any] = {"film": str(film.settings.path), "frames_left_out": film.left_out}
    try:
        with STDERR.status(f"finishing the film, {film.waiting} frames to draw"):
            figures["frames"] = film.close(FINISH_SECONDS)
    except KugliceError as error:
        # The figures of the play are worth keeping without a film too.
        STDERR.print(str(error), style="red", highlight=False, markup=False)
        figures["film_error"] = str(error)
    return figures
