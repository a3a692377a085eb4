"""One cell of the table: a subject, conditions and protocols; a game that is played, and one that is cut."""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from kuglice.lab.network.conditioner import Conditioner, open_link
from kuglice.lab.network.conditions import Conditions
from kuglice.lab.network.game import Game, Outcome
from kuglice.lab.network.subjects import Subject
from kuglice.lab.rows import Row, Value
from kuglice.study import other_screen_delays, own_screen_delays

__all__ = ["Cell"]

SETTLE_SECONDS = 1.0
CUT_SECONDS = 5.0
AFTER_CUT_SECONDS = 6.0


@dataclass(frozen=True)
class Cell:
    """`protocols`: tcp or tcp+udp. `seconds`: of play. `snapshot_every`: ticks, None for the default."""

    subject: Subject
    conditions: Conditions
    protocols: str
    seconds: float
    link: str = "auto"
    cut: bool = True
    snapshot_every: int | None = None

    @property
    def label(self) -> str:
        """For a progress bar."""
        return f"{self.subject.name}, {self.conditions}, {self.protocols}"

    def measure(self) -> list[Row]:
        """Its row; per client where that makes sense. Raises KugliceError.

        `recovery_seconds`: from the return of the link until the last client's confirmed world has all that the
        stream told (empty: not within AFTER_CUT_SECONDS). `acting_again_seconds`: until the last of the acting
        clients acts again in the server's world; bots say nothing while what they hold need not change.
        """
        with tempfile.TemporaryDirectory() as folder, open_link(self.conditions, self.link) as link:
            row: dict[str, Value] = {
                "scene": self.subject.name,
                "link": link.kind,
                "protocols": self.protocols,
                "round_trip_ms": 1000.0 * self.conditions.round_trip,
                "jitter_percent": 100.0 * self.conditions.jitter,
                "loss_percent": 100.0 * self.conditions.loss,
                "clients": self.subject.clients,
                "seconds": self.seconds,
            }
            if self.snapshot_every is not None:
                row["snapshot_every"] = self.snapshot_every
            row |= self._played(link, Path(folder) / "played")
            if self.cut:
                row |= self._cut(link, Path(folder) / "cut")
        return [row]

    def _game(self, link: Conditioner, folder: Path) -> Game:
        return Game(link, self.subject, folder, protocols=self.protocols, snapshot_every=self.snapshot_every)

    def _played(self, link: Conditioner, folder: Path) -> dict[str, Value]:
        with self._game(link, folder) as game:
            game.play(SETTLE_SECONDS)
            before, began = link.counts(), time.monotonic()
            game.play(self.seconds)
            after, spent = link.counts(), time.monotonic() - began
            outcome = game.finish()
            figures = _figures(game, outcome) | _delays(game)
        for way in ("up", "down"):
            # Of the payload alone a proxy knows nothing more than the clients do.
            wire = _of_way(after, way) - _of_way(before, way)
            figures[f"wire_{way}"] = wire / spent / self.subject.clients if link.kind == "tunnel" else ""
        return figures

    def _cut(self, link: Conditioner, folder: Path) -> dict[str, Value]:
        with self._game(link, folder) as game:
            game.play(SETTLE_SECONDS)
            link.cut(CUT_SECONDS)
            game.play(CUT_SECONDS)
            returned_at = time.monotonic()
            returned = game.recorded_ticks()
            game.play(AFTER_CUT_SECONDS)
            outcome = game.finish()
            acted = game.first_input_after(returned)
        rate = self.subject.scene.tick_rate
        return {
            "recovery_seconds": _recovery(outcome, returned_at),
            "acting_again_seconds": "" if acted is None else (acted - returned) / rate,
            "desyncs_after_cut": sum(_desyncs(client) for client in outcome.clients.values()),
            "hashes_equal_after_cut": int(outcome.hashes_equal),
        }


def _recovery(outcome: Outcome, returned_at: float) -> Value:
    """Seconds until the last client had all that was told; "" if one never had. One machine, one monotonic clock."""
    recovered = [
        next((at for at in client["feel"]["recovered_at_monotonic"] if at >= returned_at), None)
        for client in outcome.clients.values()
    ]
    times = [at for at in recovered if at is not None]
    return max(times) - returned_at if len(times) == len(recovered) else ""


def _figures(game: Game, outcome: Outcome) -> dict[str, Value]:
    clients = outcome.clients
    acting = [clients[name] for name in game.acting]
    looking = [client for name, client in clients.items() if name not in game.acting]
    accepted = sum(client["inputs_accepted"] for client in acting)
    late = sum(client["inputs_late"] for client in acting)
    return {
        "inputs": accepted,
        "late_per_1000": 1000.0 * late / accepted if accepted else "",
        "lead_ticks": _mean(client["lead_ticks"] for client in acting),
        "rollbacks_per_second": _mean(client["rollbacks"] / client["seconds"] for client in acting),
        "rollback_depth": _mean(client["feel"]["rollback_depth"] for client in acting),
        "rollback_deepest": max(client["deepest_rollback"] for client in acting),
        "correction_worst_radii": max(client["worst_correction_radii"] for client in acting),
        "visible_mean_radii": _mean(client["feel"]["correction_radii"]["mean"] for client in acting),
        "visible_worst_radii": max(client["feel"]["correction_radii"]["worst"] for client in acting),
        "onlooker_rollbacks_per_second": _mean(client["rollbacks"] / client["seconds"] for client in looking),
        "onlooker_correction_worst_radii": max(
            (client["worst_correction_radii"] for client in looking), default=""
        ),
        "onlooker_visible_mean_radii": _mean(
            client["feel"]["correction_radii"]["mean"] for client in looking
        ),
        "payload_up": _mean(client["bytes_per_second_sent"] for client in acting),
        "payload_down": _mean(client["bytes_per_second_received"] for client in clients.values()),
        "payload_down_ticks": _mean(client["bytes_per_second_ticks"] for client in clients.values()),
        "join_seconds": max(client["joined_after_seconds"] for client in clients.values()),
        "desyncs": sum(_desyncs(client) for client in clients.values()),
        "hashes_equal": int(outcome.hashes_equal),
        "server_late_ticks": outcome.server["late_ticks"],
    }


def _delays(game: Game) -> dict[str, Value]:
    """Milliseconds from an input to the first frame of 60 per second that shows it, by what the clients recorded."""
    studies = game.studies()
    own = [delay for name in game.acting for delay in own_screen_delays(studies[name])]
    other = [
        delay
        for name in game.acting
        for looking in game.names
        if looking != name
        for delay in other_screen_delays(studies[name], studies[looking])
    ]
    return {
        "own_screen_ms": _milliseconds(own, 0.5),
        "own_screen_p99_ms": _milliseconds(own, 0.99),
        "other_screen_ms": _milliseconds(other, 0.5),
        "other_screen_p99_ms": _milliseconds(other, 0.99),
    }


def _milliseconds(delays: Sequence[float], quantile: float) -> Value:
    return 1000.0 * float(np.quantile(delays, quantile)) if delays else ""


def _desyncs(client: Mapping[str, Any]) -> int:
    count: int = client["hash_mismatches"] + client["snapshot_mismatches"]
    return count


def _of_way(counts: Mapping[str, int], way: str) -> int:
    return sum(count for name, count in counts.items() if name.startswith(way) and name.endswith("bytes"))


def _mean(values: Iterable[float]) -> Value:
    listed = list(values)
    return statistics.fmean(listed) if listed else ""
