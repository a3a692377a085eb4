"""What is drawn over the balls: one file each, the same signature as a style, one table."""

from __future__ import annotations

from kuglice_client.render.overlays.scale import draw_scale
from kuglice_client.render.overlays.tick import draw_tick
from kuglice_client.render.overlays.tree import draw_tree
from kuglice_client.render.stage import Layer

__all__ = ["OVERLAYS"]

OVERLAYS: dict[str, Layer] = {
    "tick": draw_tick,
    "tree": draw_tree,
    "scale": draw_scale,
}
