"""The whole house at work: a real server and two real clients, each its own process, and a verdict.

Server and clients are started by their commands, as a user would start them; nothing here imports them.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from kuglice.errors import KugliceError
from kuglice.processes import CommandProcess, free_port
from kuglice.replay import Replay, Verification
from kuglice.world import World

__all__ = ["DemoOutcome", "DemoSettings", "play"]

POLL_SECONDS = 0.05
START_SECONDS = 20.0
RECORDING = "game.kuglice"
STILLS = 4
REFUSED = 2
"""Status of a command that says, in its last line, what the user can put right."""


@dataclass(frozen=True)
class DemoSettings:
    """`bots`: one client each. `film`: without it nothing is drawn, which needs no extras."""

    out: Path = Path("out/demo")
    scene: str = "arena:players=4,balls=600"
    bots: tuple[str, ...] = ("chaser", "orbiter")
    seconds: float = 10.0
    size: str = "960x540"
    film: bool = True
    trails: float = 0.25
    patience: float = 120.0


@dataclass(frozen=True)
class DemoOutcome:
    """What each process said at its end, and what running the recording again showed."""

    server: dict[str, Any]
    clients: dict[str, dict[str, Any]]
    verification: Verification
    recorded_hashes: dict[str, bool]
    seconds: float

    @property
    def agreed(self) -> bool:
        """Whether every client agreed with the server bit for bit, and the recording with both."""
        return (
            all(client["agreed"] for client in self.clients.values())
            and all(self.recorded_hashes.values())
            and self.verification.ok
        )

    def figures(self) -> dict[str, Any]:
        """For summary.json."""
        return {
            "agreed": self.agreed,
            "seconds": self.seconds,
            "server": self.server,
            "clients": self.clients,
            "replay": {
                "ticks": self.verification.ticks,
                "hashes": self.verification.hashes,
                "equal": self.verification.ok,
                "clients_final_state_in_it": self.recorded_hashes,
            },
        }


def play(settings: DemoSettings, progress: Callable[[float, str], None]) -> DemoOutcome:
    """Run the demo; `progress` hears of seconds played and what is going on.

    Raises KugliceError with the words of the process that failed, or if they are not done within `patience`.
    """
    began = time.monotonic()
    out = settings.out
    out.mkdir(parents=True, exist_ok=True)
    for bot in settings.bots:
        # What an earlier demo left would hide a client that ends without a word.
        _summary(settings, bot).unlink(missing_ok=True)
    endpoint = f"tcp/127.0.0.1:{free_port()}"
    processes: dict[str, CommandProcess] = {}
    try:
        processes["server"] = CommandProcess(out, "server", _server_arguments(settings, endpoint))
        for bot in settings.bots:
            processes[bot] = CommandProcess(out, bot, _client_arguments(settings, endpoint, bot))
        _wait(processes, settings, began, progress)
        clients = {bot: json.loads(_summary(settings, bot).read_text()) for bot in settings.bots}
        server = json.loads(processes["server"].stdout())
    finally:
        for process in processes.values():
            process.end()
    progress(settings.seconds, "running the recording again")
    verification, recorded = _verify(out / RECORDING, clients)
    return DemoOutcome(server, clients, verification, recorded, time.monotonic() - began)


def _summary(settings: DemoSettings, bot: str) -> Path:
    return settings.out / f"{bot}.json"


def _server_arguments(settings: DemoSettings, endpoint: str) -> list[str]:
    record = str(settings.out / RECORDING)
    return ["server", settings.scene, "--listen", endpoint, "--record", record, "--until-empty", "--json"]


def _client_arguments(settings: DemoSettings, endpoint: str, bot: str) -> list[str]:
    out = settings.out
    options = {
        "--connect": endpoint,
        "--name": bot,
        "--bot": bot,
        "--seconds": settings.seconds,
        "--wait": START_SECONDS,
        "--summary-json": _summary(settings, bot),
    }
    if settings.film:
        options |= {
            "--render": out / f"{bot}.mp4",
            "--size": settings.size,
            "--trails": settings.trails,
            "--still-every": settings.seconds / STILLS,
        }
    words = [str(word) for option in options.items() for word in option]
    return ["client", *words, "--check-snapshots", "--json"]


def _wait(
    processes: dict[str, CommandProcess],
    settings: DemoSettings,
    began: float,
    progress: Callable[[float, str], None],
) -> None:
    while any(process.code is None for process in processes.values()):
        for name, process in processes.items():
            # A client that disagreed with the server ends with 1, too, but says so: an outcome, not a failure.
            disagreed = process.code == 1 and name != "server" and _summary(settings, name).exists()
            if process.code not in (None, 0) and not disagreed:
                if process.code == REFUSED:
                    raise KugliceError(process.words().rpartition("kuglice: ")[2])
                raise KugliceError(f"{name} failed with status {process.code}:\n{process.words()}")
        elapsed = time.monotonic() - began
        if elapsed > settings.patience:
            waiting = ", ".join(process.name for process in processes.values() if process.code is None)
            raise KugliceError(f"{waiting}: not done after {settings.patience:g} s")
        played = min(elapsed, settings.seconds)
        progress(played, "playing" if elapsed < settings.seconds + 1 else "finishing the films")
        time.sleep(POLL_SECONDS)


def _verify(path: Path, clients: dict[str, dict[str, Any]]) -> tuple[Verification, dict[str, bool]]:
    wanted = {client["final_tick"]: client["final_hash"] for client in clients.values()}
    found: dict[int, str] = {}

    def watch(world: World) -> None:
        if world.tick in wanted:
            found[world.tick] = f"{world.state_hash:016x}"

    verification = Replay.load(path).verify(watch)
    recorded = {
        name: found.get(client["final_tick"]) == client["final_hash"] for name, client in clients.items()
    }
    return verification, recorded
