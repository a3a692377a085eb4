"""Real commands in processes of their own: started on free ports, always ended, their words kept."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Self

__all__ = ["Command", "free_endpoint", "until"]


def free_endpoint() -> str:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{probe.getsockname()[1]}"


def until(
    condition: Callable[[], Any], *, seconds: float = 60.0, every: float = 0.005, what: str = "condition"
) -> Any:
    """The first true value of `condition`; fails after a time that only something broken would take."""
    deadline = time.monotonic() + seconds
    while True:
        value = condition()
        if value:
            return value
        assert time.monotonic() < deadline, f"{what}: not within {seconds} s"
        time.sleep(every)


class Command:
    """`kuglice ARGUMENTS`, killed at the end of the `with` if it has not ended by itself.

    `prefix`: words before the command, for one that enters another place first.
    """

    def __init__(self, folder: Path, *arguments: object, prefix: Sequence[str] = ()) -> None:
        self._folder = folder
        self._prefix = prefix
        self._arguments = [str(argument) for argument in arguments]
        self._stem = f"{self._arguments[0]}-{len(list(folder.glob('*.err')))}"

    def __enter__(self) -> Self:
        with self._file("out").open("wb") as out, self._file("err").open("wb") as err:
            self._process = subprocess.Popen(
                [*self._prefix, sys.executable, "-m", "kuglice", *self._arguments],
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=err,
                env={**os.environ, "COLUMNS": "200"},
                start_new_session=True,
            )
        return self

    def __exit__(self, *_: object) -> None:
        if self._process.poll() is None:
            self.kill()

    def _file(self, kind: str) -> Path:
        return self._folder / f"{self._stem}.{kind}"

    @property
    def pid(self) -> int:
        return self._process.pid

    @property
    def running(self) -> bool:
        return self._process.poll() is None

    @property
    def out(self) -> str:
        return self._file("out").read_text()

    @property
    def err(self) -> str:
        return self._file("err").read_text()

    def signal(self, number: signal.Signals) -> None:
        self._process.send_signal(number)

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()

    def wait(self, *, seconds: float = 120.0) -> int:
        """The exit status."""
        try:
            return self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"{self._arguments}: still running after {seconds} s:\n{self.err}") from None

    def end(self) -> dict[str, Any]:
        """What it printed with --json, told to end now."""
        self.signal(signal.SIGINT)
        return self.figures()

    def figures(self, *, status: int = 0) -> dict[str, Any]:
        """What it printed with --json, once it has ended with `status`."""
        found = self.wait()
        assert found == status, f"{self._arguments}: status {found}, not {status}:\n{self.err}"
        figures: dict[str, Any] = json.loads(self.out)
        return figures
