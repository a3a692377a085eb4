"""How the closing figures of a client and of a view are grouped for people; programs get them as they are."""

from __future__ import annotations

__all__ = ["CLIENT", "CLIENT_SILENT", "VIEW", "VIEW_SILENT"]

CLIENT = {
    "session": ("name", "number", "world", "epoch", "links", "seconds", "joined_after_seconds", "rejoins"),
    "state": (
        "final_tick",
        "final_hash",
        "agreed",
        "hashes_checked",
        "hash_mismatches",
        "snapshots_checked",
        "snapshot_mismatches",
        "snapshots_taken",
        "snapshots_too_old",
    ),
    "inputs": ("inputs_accepted", "inputs_refused", "inputs_late"),
    "prediction": (
        "lead_ticks",
        "rollbacks",
        "deepest_rollback",
        "ticks_rerun",
        "worst_correction_radii",
        "step_milliseconds",
    ),
    "network": (
        "bytes_per_second_received",
        "bytes_per_second_ticks",
        "bytes_per_second_snapshots",
        "bytes_per_second_sent",
        "bytes_joining",
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
    "feel": ("feel",),
    "film": ("film", "frames", "frames_left_out", "film_error"),
}
CLIENT_SILENT = frozenset(
    {
        "rejoins",
        "snapshots_checked",
        "snapshots_taken",
        "snapshots_too_old",
        "snapshot_mismatches",
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
        "feel",
        "frames_left_out",
    }
)

VIEW = {
    "session": ("world", "epoch", "links", "seconds", "joined_after_seconds", "rejoins", "final_tick"),
    "in sight": ("rectangle", "balls_in_sight", "balls_followed", "balls_of_the_world"),
    "regions": ("regions_followed", "regions_by_pace", "regions_left_out"),
    "network": (
        "updates",
        "bytes_per_update",
        "bytes_per_ball_told",
        "bytes_per_second_received",
        "bytes_per_second_budget",
        "bytes_joining",
        "link_renewals",
        "updates_too_old",
        "malformed_messages",
    ),
    "prediction": (
        "told_within_radii",
        "prediction_error_radii",
        "correction_radii",
        "rewinds",
        "ticks_rerun",
        "jumps",
        "unusable_ticks",
    ),
    "film": ("film", "frames", "frames_left_out", "film_error"),
}
VIEW_SILENT = frozenset(
    {
        "rejoins",
        "regions_left_out",
        "bytes_per_second_budget",
        "link_renewals",
        "updates_too_old",
        "malformed_messages",
        "jumps",
        "unusable_ticks",
        "frames_left_out",
    }
)
