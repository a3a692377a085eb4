"""Where methods fail, beside the theory of where they should."""

from kuglice.lab.stability_maps.draw import draw
from kuglice.lab.stability_maps.measure import jobs

__all__ = ["draw", "jobs"]
