"""A crowd of listeners in processes of their own, from the side of whoever counts them."""

from __future__ import annotations

import json
import select
import subprocess
import sys
from dataclasses import dataclass
from typing import Any, Self

from kuglice.errors import NetworkError
from kuglice.lab.capacity.processor import processor_seconds

__all__ = ["Crowd", "Heard"]

SESSIONS_PER_PROCESS = 64
ANSWER_SECONDS = 60.0
END_SECONDS = 10.0
STEPS_ASIDE = 5
"""Listeners stand for other machines: where they and the server want the same core, the server goes first."""


@dataclass
class Heard:
    """What all sessions together heard between two reports."""

    messages: int
    missed: int
    bytes: int
    malformed: int


class Crowd:
    """A context manager; `grow` adds sessions of that kind that connect to `endpoint`. Raises NetworkError."""

    def __init__(self, world: str, kind: str = "client") -> None:
        self._world = world
        self._kind = kind
        self._processes: list[subprocess.Popen[bytes]] = []
        self._before: list[dict[str, Any]] = []

    def grow(self, sessions: int, endpoint: str) -> None:
        """Add that many."""
        while sessions > 0:
            some = min(sessions, SESSIONS_PER_PROCESS)
            listeners = [sys.executable, "-m", "kuglice.lab.capacity.listeners", endpoint]
            process = subprocess.Popen(
                ["nice", "-n", str(STEPS_ASIDE), *listeners, self._world, self._kind],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                bufsize=0,
                start_new_session=True,
            )
            self._processes.append(process)
            self._ask(process, some)
            sessions -= some

    def heard(self) -> Heard:
        """Since the last call."""
        reports = [report for process in self._processes for report in self._ask(process, None)]
        before = self._before + [{} for _ in range(len(reports) - len(self._before))]
        self._before = reports
        heard = Heard(0, 0, 0, 0)
        for old, new in zip(before, reports, strict=True):
            came = new["messages"] - old.get("messages", 0)
            heard.messages += came
            heard.bytes += new["bytes"] - old.get("bytes", 0)
            heard.malformed += new["malformed"] - old.get("malformed", 0)
            heard.missed += max(0, new["told"] - old.get("told", 0) - came)
        return heard

    @property
    def processor_seconds(self) -> float:
        """Of all processes of the crowd."""
        return sum(processor_seconds(process.pid) for process in self._processes)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for process in self._processes:
            for pipe in (process.stdin, process.stdout):
                if pipe is not None:
                    pipe.close()
        for process in self._processes:
            try:
                process.wait(END_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def _ask(self, process: subprocess.Popen[bytes], sessions: int | None) -> list[dict[str, Any]]:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(b"\n" if sessions is None else b"%d\n" % sessions)
        except OSError as error:
            raise NetworkError(f"listeners ended: {error}") from error
        ready, _, _ = select.select([process.stdout], [], [], ANSWER_SECONDS)
        line = _line(process) if ready else b""
        if not line:
            raise NetworkError(f"listeners do not answer within {ANSWER_SECONDS:g} s")
        reports: list[dict[str, Any]] = json.loads(line)
        return reports


def _line(process: subprocess.Popen[bytes]) -> bytes:
    assert process.stdout is not None
    line = b""
    while not line.endswith(b"\n"):
        some = process.stdout.read(65_536)
        if not some:
            return b""
        line += some
    return line
