"""A network that misbehaves on purpose, and what that does to a game: `kuglice bench network`."""

from __future__ import annotations

from kuglice.lab.network.conditioner import Conditioner, ProxyLink, TunnelLink, open_link
from kuglice.lab.network.conditions import Conditions

__all__ = ["Conditioner", "Conditions", "ProxyLink", "TunnelLink", "open_link"]
