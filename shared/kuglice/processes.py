"""Commands of this package in processes of their own, as a user would start them."""

from __future__ import annotations

import errno
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from kuglice.errors import KugliceError

__all__ = ["CommandProcess", "free_port"]

STOP_SECONDS = 5.0
POLL_SECONDS = 0.02


class CommandProcess:
    """`kuglice ARGUMENTS`, running since it was made; what it says goes to files, so no pipe can fill up.

    `prefix`: words before the command, for one that enters another place first.
    """

    def __init__(
        self, folder: Path, name: str, arguments: Sequence[object], *, prefix: Sequence[str] = ()
    ) -> None:
        self.name = name
        self._log = folder / f"{name}.log"
        self._data = folder / f"{name}.stdout.json"
        with self._log.open("wb") as log, self._data.open("wb") as data:
            self._process = subprocess.Popen(
                [*prefix, sys.executable, "-m", "kuglice", *map(str, arguments)],
                stdin=subprocess.DEVNULL,
                stdout=data,
                stderr=log,
                env={**os.environ, "PYTHONUNBUFFERED": "1"},
                # Ctrl-C is ours to hear; we then stop them in order.
                start_new_session=True,
            )

    @property
    def pid(self) -> int:
        """Of the command, or of the prefix that became it."""
        return self._process.pid

    @property
    def code(self) -> int | None:
        """Its exit status, None while it runs."""
        return self._process.poll()

    def stdout(self) -> str:
        """The data that it printed."""
        return self._data.read_text()

    def log(self) -> str:
        """All that it said on stderr so far."""
        return self._log.read_text(errors="replace")

    def words(self) -> str:
        """The last of it, for people."""
        return "\n".join(self.log().strip().splitlines()[-12:])

    def wait_for_words(self, wanted: str, seconds: float) -> None:
        """Until it has said that on stderr. Raises KugliceError, with what it said instead, if it does not."""
        deadline = time.monotonic() + seconds
        while wanted not in self.log():
            if self.code is not None or time.monotonic() > deadline:
                end = f"within {seconds:g} s" if self.code is None else f"but ended with status {self.code}"
                raise KugliceError(f"{self.name} did not say {wanted!r} {end}:\n{self.words()}")
            time.sleep(POLL_SECONDS)

    def interrupt(self) -> None:
        """Ask it to finish, as Ctrl-C would."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)

    def wait(self, seconds: float) -> int | None:
        """Its exit status, None if it runs for longer still."""
        try:
            return self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None

    def end(self) -> None:
        """Make sure that it runs no more."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGTERM)
            if self.wait(STOP_SECONDS) is None:
                self._process.kill()
                self._process.wait()
        self._data.unlink(missing_ok=True)


def free_port() -> int:
    """One on which nothing listens now, neither for TCP nor for UDP."""
    while True:
        with socket.socket() as probe, socket.socket(type=socket.SOCK_DGRAM) as datagrams:
            probe.bind(("127.0.0.1", 0))
            port: int = probe.getsockname()[1]
            try:
                datagrams.bind(("127.0.0.1", port))
            except OSError as error:
                # Free for TCP alone: others have datagrams under way.
                if error.errno != errno.EADDRINUSE:
                    raise
                continue
            return port
