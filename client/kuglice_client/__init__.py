"""The headless client: follows a server through its own step, predicts, acts and reconciles."""

from kuglice_client.bots import BOTS, Bot, Sight
from kuglice_client.client import Client
from kuglice_client.outbox import Outcome
from kuglice_client.settings import ClientSettings

__all__ = ["BOTS", "Bot", "Client", "ClientSettings", "Outcome", "Sight"]
