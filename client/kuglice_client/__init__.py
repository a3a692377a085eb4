"""The headless client: follows a server through its own step, predicts, acts and reconciles."""

from kuglice_client.bots import BOTS
from kuglice_client.client import Client
from kuglice_client.settings import ClientSettings

__all__ = ["BOTS", "Client", "ClientSettings"]
