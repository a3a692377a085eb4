"""The table of `kuglice bench network` as the readme shows it."""

from __future__ import annotations

from collections.abc import Callable

from kuglice.lab.rows import Row, Rows, Value

__all__ = ["markdown"]


def markdown(rows: Rows) -> str:
    """One line per cell; corrections in radii, bytes per second and client."""
    heads = [head for head, _ in COLUMNS]
    lines = [_line(heads), _line(["---", "---", *["---:"] * (len(heads) - 2)])]
    lines += [_line([show(row) for _, show in COLUMNS]) for row in rows]
    return "\n".join(lines) + "\n"


def _line(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _link(row: Row) -> str:
    parts = [f"{row['round_trip_ms']:g} ms"]
    parts += [f"± {row['jitter_percent']:g} %"] if row["jitter_percent"] else []
    parts += [f"{row['loss_percent']:g} % lost"] if row["loss_percent"] else []
    return f"{', '.join(parts)}, {row['protocols']}"


def _figures(*names: str, between: str = " / ") -> Callable[[Row], str]:
    return lambda row: between.join(_shown(row.get(name, "")) for name in names)


def _thousands(*names: str) -> Callable[[Row], str]:
    return lambda row: " / ".join(
        _shown(value / 1000.0) if isinstance(value := row.get(name, ""), int | float) else "-"
        for name in names
    )


def _shown(value: Value) -> str:
    if not isinstance(value, int | float):
        return value or "-"
    if value == 0:
        return "0"
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.2g}"


def _equal(row: Row) -> str:
    after = row.get("hashes_equal_after_cut", 1)
    return "yes" if row["hashes_equal"] and after and not row["desyncs"] else "NO"


COLUMNS: tuple[tuple[str, Callable[[Row], str]], ...] = (
    ("scene", lambda row: str(row["scene"])),
    ("link", _link),
    ("rollbacks/s, depth", _figures("rollbacks_per_second", "rollback_depth", between=", ")),
    ("to own / other screen, ms", _figures("own_screen_ms", "other_screen_ms")),
    (
        "visible correction in radii: mean, worst",
        _figures("visible_mean_radii", "visible_worst_radii", between=", "),
    ),
    ("lead, ticks", _figures("lead_ticks")),
    ("late ‰", _figures("late_per_1000")),
    ("payload kB/s up / down", _thousands("payload_up", "payload_down")),
    ("wire kB/s up / down", _thousands("wire_up", "wire_down")),
    ("join s", _figures("join_seconds")),
    ("recovery s", _figures("recovery_seconds")),
    ("hashes equal", _equal),
)
