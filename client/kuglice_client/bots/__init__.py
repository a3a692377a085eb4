"""Players without a person: one file each, one table."""

from kuglice_client.bots.chaser import chaser
from kuglice_client.bots.drifter import drifter
from kuglice_client.bots.herder import herder
from kuglice_client.bots.orbiter import orbiter
from kuglice_client.bots.sight import Bot, Sight

__all__ = ["BOTS", "Bot", "Sight"]

BOTS: dict[str, Bot] = {
    "chaser": chaser,
    "drifter": drifter,
    "herder": herder,
    "orbiter": orbiter,
}
