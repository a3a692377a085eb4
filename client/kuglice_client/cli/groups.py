"""How the closing figures of a client and of a view are grouped for people; programs get them as they are."""

from __future__ import annotations

from kuglice.cli.figures import Group

__all__ = ["CLIENT", "VIEW"]

FILM = Group(("film", "frames", "film_error"), troubles=("frames_left_out",))

CLIENT = {
    "session": Group(
        ("name", "number", "world", "epoch", "links", "seconds", "joined_after_seconds"),
        troubles=("rejoins",),
    ),
    "state": Group(
        ("final_tick", "final_hash", "agreed", "hashes_checked", "hash_mismatches"),
        troubles=("snapshots_checked", "snapshot_mismatches", "snapshots_taken", "snapshots_too_old"),
    ),
    "inputs": Group(("inputs_accepted", "inputs_refused", "inputs_late")),
    "prediction": Group(
        (
            "lead_ticks",
            "rollbacks",
            "deepest_rollback",
            "ticks_rerun",
            "worst_correction_radii",
            "step_milliseconds",
        )
    ),
    "network": Group(
        ("bytes_per_second_received", "bytes_per_second_ticks", "bytes_per_second_sent", "bytes_joining"),
        troubles=(
            "bytes_per_second_snapshots",
            "link_renewals",
            "messages_missed",
            "messages_thrown_away",
            "malformed_messages",
            "ticks_behind",
            "ticks_healed_by_repeats",
            "ticks_healed_by_history",
            "ticks_unusable",
            "gaps_skipped",
            "silences_asked",
        ),
    ),
    "feel": Group((), troubles=("feel",)),
    "film": FILM,
}

VIEW = {
    "session": Group(
        ("world", "epoch", "links", "seconds", "joined_after_seconds", "final_tick"), troubles=("rejoins",)
    ),
    "in sight": Group(("rectangle", "balls_in_sight", "balls_followed", "balls_of_the_world")),
    "regions": Group(("regions_followed", "regions_by_pace"), troubles=("regions_left_out",)),
    "network": Group(
        (
            "updates",
            "balls_told",
            "bytes_per_update",
            "bytes_per_ball_told",
            "bytes_per_second_received",
            "bytes_joining",
        ),
        troubles=("bytes_per_second_budget", "link_renewals", "updates_too_old", "malformed_messages"),
    ),
    "prediction": Group(
        ("told_within_radii", "prediction_error_radii", "correction_radii", "rewinds", "ticks_rerun"),
        troubles=("jumps", "unusable_ticks"),
    ),
    "film": FILM,
}
