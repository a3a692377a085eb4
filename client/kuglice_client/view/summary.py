"""What a view's session was like, in figures."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np

from kuglice_client.totals import Figure
from kuglice_client.view.partial_replica import PartialReplica

if TYPE_CHECKING:
    from kuglice_client.view.view import View

__all__ = ["figures", "summarise"]


def figures(replica: PartialReplica) -> dict[str, Figure]:
    """Of the present run of the server only; Totals adds them up over all runs."""
    known = replica.known
    return {
        "updates": replica.updates,
        "balls_told": replica.balls_told,
        "updates_too_old": known.too_old,
        "rewinds": known.rewinds,
        "ticks_rerun": known.ticks_rerun,
        "jumps": known.jumps,
        "unusable_ticks": known.unusable,
    }


def summarise(view: View, *, seconds: float) -> dict[str, Any]:
    """Values for JSON. Errors are distances between told and predicted places of balls in sight, in radii."""
    replica, accuracy = view.replica, view.accuracy
    about, known, interest = replica.about, replica.known, replica.interest
    summed = view.totals.with_past(figures(replica))
    updates, balls_told = summed["updates"], summed["balls_told"]
    region_bytes = view.link.traffic.received["regions"]
    rates = view.link.traffic.per_second(seconds)
    paces = Counter(interest.paces.values())
    radius = known.world.radius
    smallest = float(np.min(radius)) if len(radius) else None
    bound = about.regions.position_quantum / 2
    return {
        "world": about.world,
        "epoch": about.epoch,
        "links": "+".join(view.link.kinds),
        "link_renewals": view.renewal.renewals,
        "seconds": seconds,
        "joined_after_seconds": view.joined_after,
        "final_tick": known.world.tick,
        "rectangle": list(view.rectangle),
        "balls_of_the_world": about.balls,
        "balls_in_sight": int(view.in_sight.sum()),
        "balls_followed": known.world.count,
        "regions_followed": len(interest.paces),
        "regions_by_pace": {f"1/{1 << pace}": paces[pace] for pace in sorted(paces)},
        "regions_left_out": interest.left_out,
        "bytes_per_update": region_bytes / updates if updates else None,
        "bytes_per_ball_told": region_bytes / balls_told if balls_told else None,
        **summed,
        "malformed_messages": view.malformed,
        "rejoins": view.totals.rejoins,
        "bytes_per_second_received": rates["received"],
        "bytes_per_second_budget": view.settings.budget,
        "bytes_joining": view.link.traffic.received["joining"],
        "told_within_radii": None if smallest is None else bound / smallest,
        "prediction_error_radii": {
            "compared": accuracy.compared,
            "mean": accuracy.mean,
            "p99": accuracy.quantile(0.99),
            "worst": accuracy.worst,
        },
        "correction_radii": {"mean": view.correction.mean, "worst": view.correction.worst},
    }
