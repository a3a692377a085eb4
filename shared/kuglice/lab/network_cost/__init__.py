"""What distance costs: error on the screen and bytes on the wire, against round trip and rate of updates."""

from kuglice.lab.network_cost.draw import draw
from kuglice.lab.network_cost.measure import jobs

__all__ = ["draw", "jobs"]
