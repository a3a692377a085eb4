"""What a client's session was like, in figures."""

from __future__ import annotations

from typing import Any

from kuglice_client.link import Link
from kuglice_client.replica import Replica
from kuglice_client.screen import Screen
from kuglice_client.totals import Figure, Totals

__all__ = ["figures", "summarise"]


def figures(replica: Replica, screen: Screen) -> dict[str, Figure]:
    """Of the present run of the server only; Totals adds them up over all runs."""
    outbox = None if replica.player is None else replica.player.outbox
    checks, prediction, follower = replica.reconciler, replica.prediction, replica.follower
    return {
        "hashes_checked": checks.hashes_checked,
        "hash_mismatches": checks.hash_mismatches,
        "snapshots_checked": checks.snapshots_checked,
        "snapshot_mismatches": checks.snapshot_mismatches,
        "snapshots_taken": checks.snapshots_taken,
        "snapshots_too_old": checks.snapshots_too_old,
        "inputs_accepted": 0 if outbox is None else outbox.accepted,
        "inputs_refused": 0 if outbox is None else outbox.refused,
        "inputs_late": 0 if outbox is None else outbox.late,
        "rollbacks": prediction.rollbacks,
        "deepest_rollback": prediction.deepest_rollback,
        "ticks_rerun": prediction.ticks_rerun,
        "worst_correction_radii": screen.correction.worst_jump,
        "messages_missed": follower.missed_messages,
        "ticks_healed_by_repeats": follower.healed_by_repeats,
        "ticks_healed_by_history": follower.healed_by_history,
        "ticks_unusable": follower.unusable,
        "gaps_skipped": replica.healing.gaps_skipped,
        "silences_asked": replica.healing.silences,
    }


def summarise(
    replica: Replica,
    screen: Screen,
    link: Link,
    totals: Totals,
    *,
    name: str | None,
    renewals: int,
    joined_after: float,
    step_seconds: float,
    seconds: float,
) -> dict[str, Any]:
    """Values for JSON. `agreed`: every hash and every snapshot was the server's."""
    joined, confirmed = replica.joined, replica.follower.world
    summed = totals.with_past(figures(replica, screen))
    rates = link.traffic.per_second(seconds)
    return {
        "name": name,
        "number": joined.number,
        "world": joined.about.world,
        "epoch": joined.epoch,
        "links": "+".join(link.kinds),
        "link_renewals": renewals,
        "seconds": seconds,
        "joined_after_seconds": joined_after,
        "final_tick": confirmed.tick,
        "final_hash": f"{confirmed.state_hash:016x}",
        "agreed": summed["hashes_checked"] > 0
        and summed["hash_mismatches"] == 0
        and summed["snapshot_mismatches"] == 0,
        **summed,
        "messages_thrown_away": totals.messages_thrown_away,
        "malformed_messages": link.malformed + totals.malformed_snapshots,
        "rejoins": totals.rejoins,
        "lead_ticks": replica.clock.lead,
        "ticks_behind": replica.follower.behind,
        "step_milliseconds": 1000 * step_seconds,
        "bytes_per_second_received": rates["received"],
        "bytes_per_second_ticks": rates.get("ticks", 0.0),
        "bytes_per_second_snapshots": rates.get("snapshots", 0.0),
        "bytes_per_second_sent": rates["sent"],
        "bytes_joining": link.traffic.received["joining"],
        "feel": _feel(replica, screen, summed, seconds),
    }


def _feel(replica: Replica, screen: Screen, summed: dict[str, Figure], seconds: float) -> dict[str, Any]:
    feel, correction, clock = screen.feel, screen.correction, replica.clock
    accepted, rollbacks = summed["inputs_accepted"], summed["rollbacks"]
    return {
        "inputs": feel.inputs,
        "late_per_1000": 1000 * summed["inputs_late"] / accepted if accepted else None,
        "own_input_delay_ms": feel.own_input_delay(),
        "rollbacks_per_second": rollbacks / max(seconds, 1e-9),
        "rollback_depth": summed["ticks_rerun"] / rollbacks if rollbacks else 0.0,
        "correction_radii": {
            "mean": correction.mean,
            "worst": correction.worst,
            "snapped_balls": correction.snaps,
        },
        "round_trip_ms": 1000 * clock.round_trip,
        "jitter_ms": 1000 * clock.jitter,
        "catching_up_seconds": max(feel.recovery) if feel.recovery else None,
        "recovered_at_monotonic": feel.recovered_at,
    }
