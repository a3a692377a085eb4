"""The way to a server: a session is opened, asked and told over, looked after, and opened anew after a cut."""

from kuglice_client.link.ask import Asked
from kuglice_client.link.datagram_watch import DatagramWatch
from kuglice_client.link.link import Link
from kuglice_client.link.renewal import Renewal
from kuglice_client.link.waiting import NotYetError, Waiting

__all__ = ["Asked", "DatagramWatch", "Link", "NotYetError", "Renewal", "Waiting"]
