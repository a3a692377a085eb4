"""Other people's engines on the very same initial state. One file per peer, one signature, one table."""

from kuglice.lab.peers.table import PEERS, Peer

__all__ = ["PEERS", "Peer"]
