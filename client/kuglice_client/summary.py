"""What a client's session was like, in figures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kuglice_client.totals import Figure

if TYPE_CHECKING:
    from kuglice_client.client import Client

__all__ = ["figures", "summarise"]


def figures(client: Client) -> dict[str, Figure]:
    """Of the present run of the server only; Totals adds them up over all runs."""
    outbox, checks = client.outbox, client.reconciler
    prediction, follower = client.prediction, client.follower
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
        "worst_correction_radii": prediction.worst_correction,
        "messages_missed": follower.missed_messages,
        "ticks_healed_by_repeats": follower.healed_by_repeats,
        "ticks_healed_by_history": follower.healed_by_history,
        "ticks_unusable": follower.unusable,
        "gaps_skipped": client.healing.gaps_skipped,
    }


def summarise(client: Client, *, seconds: float) -> dict[str, Any]:
    """Values for JSON. `agreed`: every hash and every snapshot was the server's."""
    summed = client.totals.with_past(figures(client))
    traffic = client.link.traffic
    rates = traffic.per_second(seconds)
    return {
        "name": client.settings.name,
        "number": client.joined.number,
        "world": client.joined.about.world,
        "epoch": client.joined.epoch,
        "links": "+".join(client.link.kinds),
        "seconds": seconds,
        "joined_after_seconds": client.joined_after,
        "final_tick": client.confirmed.tick,
        "final_hash": f"{client.confirmed.state_hash:016x}",
        "agreed": summed["hashes_checked"] > 0
        and summed["hash_mismatches"] == 0
        and summed["snapshot_mismatches"] == 0,
        **summed,
        "messages_thrown_away": client.totals.messages_thrown_away,
        "malformed_messages": client.link.malformed + client.totals.malformed_snapshots,
        "rejoins": client.totals.rejoins,
        "lead_ticks": client.clock.lead,
        "ticks_behind": client.follower.behind,
        "bytes_per_second_received": rates["received"],
        "bytes_per_second_ticks": rates.get("ticks", 0.0),
        "bytes_per_second_snapshots": rates.get("snapshots", 0.0),
        "bytes_per_second_sent": rates["sent"],
        "bytes_joining": traffic.received["joining"],
    }
