"""Ways to draw balls: one file each, the same signature, one table."""

from __future__ import annotations

from kuglice_client.render.stage import Layer
from kuglice_client.render.styles.discs import draw_discs
from kuglice_client.render.styles.fluid import draw_fluid

__all__ = ["STYLES"]

STYLES: dict[str, Layer] = {
    "discs": draw_discs,
    "fluid": draw_fluid,
}
