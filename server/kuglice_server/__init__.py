"""The authority over a world: it steps, and what it says happened."""

from kuglice_server.server import Server
from kuglice_server.settings import ServerSettings

__all__ = ["Server", "ServerSettings"]
