"""The authority over a world: it steps, and what it says happened."""

from kuglice_server.server import Server, ServerSettings

__all__ = ["Server", "ServerSettings"]
