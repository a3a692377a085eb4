"""A conditioned link, from the side of whoever starts server and clients: how to start them, and what to order."""

from __future__ import annotations

import json
import select
import subprocess
import sys
from collections.abc import Mapping
from typing import Any

from kuglice.closing import Closing
from kuglice.errors import NetworkError
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.tun_device import why_impossible
from kuglice.lab.network.tunnel import SERVER_ADDRESS
from kuglice.processes import free_port

__all__ = ["LINKS", "Conditioner", "ProxyLink", "TunnelLink", "open_link"]

LINKS = ("auto", "tunnel", "proxy")
ANSWER_SECONDS = 60.0
END_SECONDS = 5.0
TUNNEL_PORT = 7447


class Conditioner(Closing):
    """A process that conditions a link; a context manager. Its stdin is its life: it ends with us.

    `server_prefix` and `client_prefix` come before the commands that are to use the link; the server listens on
    `server_address`, a host and a port, and clients connect to `client_address`.
    """

    kind = ""
    server_prefix: tuple[str, ...] = ()
    client_prefix: tuple[str, ...] = ()
    server_address = ""
    client_address = ""

    def __init__(self, arguments: tuple[str, ...], conditions: Conditions) -> None:
        self.conditions = conditions
        self._process = subprocess.Popen(
            [sys.executable, "-m", "kuglice.lab.network", *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            # Ctrl-C is for us to hear: the link lasts until its users have left.
            start_new_session=True,
        )
        try:
            self.told = self._answer()
            self.change(conditions)
        except BaseException:
            self.close()
            raise

    def change(self, conditions: Conditions) -> None:
        """Other conditions from now on."""
        self.conditions = conditions
        self._order("change", conditions.to_message())

    def cut(self, seconds: float) -> None:
        """Nothing gets through for that long, and what is sent is lost; returns at once.

        A cut that lasts longer stays. Raises NetworkError for more than an hour, or less than nothing.
        """
        self._order("cut", seconds)

    def mend(self) -> None:
        """End a cut now."""
        self._order("mend", True)

    def stall(self, seconds: float) -> None:
        """Nothing gets through for that long, and then all of it; returns at once. Otherwise like `cut`."""
        self._order("stall", seconds)

    def counts(self) -> Mapping[str, int]:
        """Bytes and packets since the start: "up tcp bytes", "down udp lost", ..."""
        counts: dict[str, int] = self._order("count", True)["counts"]
        return counts

    def close(self) -> None:
        """End the process, and with it the link."""
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()
        try:
            self._process.wait(END_SECONDS)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _order(self, name: str, value: object) -> dict[str, Any]:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(json.dumps({name: value}).encode() + b"\n")
        except OSError as error:
            raise NetworkError(f"the {self.kind} has ended: {error}") from error
        answer = self._answer()
        if "error" in answer:
            raise NetworkError(answer["error"])
        return answer

    def _answer(self) -> dict[str, Any]:
        pipe = self._process.stdout
        assert pipe is not None
        ready, _, _ = select.select([pipe], [], [], ANSWER_SECONDS)
        line = pipe.readline() if ready else b""
        if not line:
            raise NetworkError(f"the {self.kind} does not answer: see above for its reason")
        answer: dict[str, Any] = json.loads(line)
        return answer


class ProxyLink(Conditioner):
    """Two ports of this machine; payload is delayed, and datagrams are lost."""

    kind = "proxy"

    def __init__(self, conditions: Conditions) -> None:
        self.server_address = f"127.0.0.1:{free_port()}"
        self.client_address = f"127.0.0.1:{free_port()}"
        super().__init__(("proxy", self.client_address, self.server_address), conditions)


class TunnelLink(Conditioner):
    """Two network namespaces; whole IP packets are delayed and lost. Raises NetworkError without root."""

    kind = "tunnel"

    def __init__(self, conditions: Conditions) -> None:
        reason = why_impossible()
        if reason is not None:
            raise NetworkError(f"tunnel: {reason}")
        super().__init__(("tunnel",), conditions)
        self.server_prefix = ("nsenter", f"--net={self.told['server_namespace']}")
        self.client_prefix = ("nsenter", f"--net={self.told['client_namespace']}")
        self.server_address = self.client_address = f"{SERVER_ADDRESS}:{TUNNEL_PORT}"


def open_link(conditions: Conditions, kind: str = "auto") -> Conditioner:
    """A tunnel where one can be made, else a proxy ("auto"), or the one that is asked for. Raises NetworkError."""
    match kind:
        case "auto":
            return TunnelLink(conditions) if why_impossible() is None else ProxyLink(conditions)
        case "tunnel":
            return TunnelLink(conditions)
        case "proxy":
            return ProxyLink(conditions)
        case _:
            raise NetworkError(f"link {kind!r}: must be one of {', '.join(LINKS)}")
