"""`kuglice demo`: a server and two clients play, and agree bit for bit, or not."""

from __future__ import annotations

import json
import signal
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from kuglice.cli.figures import print_figures
from kuglice.cli.logs import STDERR
from kuglice.cli.writable import writable_folder
from kuglice.demo import DemoOutcome, DemoSettings, play
from kuglice.extras import require

__all__ = ["register"]

DEFAULTS = DemoSettings()


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("demo")(demo)


def demo(
    *,
    out: Annotated[
        Path,
        typer.Option(callback=writable_folder, help="Folder for films, frames, replay and summary.json."),
    ] = DEFAULTS.out,
    seconds: Annotated[float, typer.Option(min=1.0, help="How long the clients play.")] = DEFAULTS.seconds,
    scene: Annotated[str, typer.Option(help="What they play in.")] = DEFAULTS.scene,
    bot: Annotated[list[str] | None, typer.Option(help="One client each. [default: chaser, orbiter]")] = None,
    size: Annotated[str, typer.Option(help="Width and height of the films in pixels.")] = DEFAULTS.size,
    film: Annotated[bool, typer.Option(help="Draw what the clients see.")] = True,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as JSON.")] = False,
) -> None:
    """Let two clients play on a server, and compare every bit.

    All are processes of their own. The clients steer through one crowd of balls over the network, each on
    its own copy of the world. The last lines say whether every copy was equal to the server's in every
    bit. Ends with status 1 if one was not.
    """
    # However it is ended, the processes that it started are ended too.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    if film:
        require("render")
    settings = DemoSettings(
        out=out, scene=scene, bots=tuple(bot or DEFAULTS.bots), seconds=seconds, size=size, film=film
    )
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=STDERR, transient=True, disable=not STDERR.is_terminal) as progress:
        task = progress.add_task("starting", total=seconds)
        outcome = play(settings, lambda done, what: progress.update(task, completed=done, description=what))
    (out / "summary.json").write_text(json.dumps(outcome.figures(), indent=2) + "\n")
    if as_json:
        print(json.dumps(outcome.figures(), indent=2))
    else:
        columns_shown = {name: _column(outcome, name) for name in outcome.clients}
        print_figures(f"{scene}, {len(outcome.clients)} clients", columns_shown, as_json=False)
        print(_verdict(outcome, out, film=film))
    if not outcome.agreed:
        raise typer.Exit(1)


def _column(outcome: DemoOutcome, name: str) -> dict[str, Any]:
    client = outcome.clients[name]
    return {
        "ticks": client["hashes_checked"],
        "hash mismatches": client["hash_mismatches"],
        "snapshots checked": client["snapshots_checked"],
        "snapshot mismatches": client["snapshot_mismatches"],
        "inputs accepted": client["inputs_accepted"],
        "inputs late": client["inputs_late"],
        "bytes per second received": client["bytes_per_second_received"],
        "bytes per second sent": client["bytes_per_second_sent"],
        "rollbacks": client["rollbacks"],
        "worst correction in radii": client["worst_correction_radii"],
        **({"frames drawn": client["frames"]} if "frames" in client else {}),
    }


def _verdict(outcome: DemoOutcome, out: Path, *, film: bool) -> str:
    replay = outcome.verification
    lines = [
        f"{'films, frames, ' if film else ''}replay and summary.json are in {out} ({outcome.seconds:.1f} s in all)",
        f"server: {outcome.server['ticks']} ticks, {outcome.server['inputs_applied']} inputs applied, "
        f"{outcome.server['late_ticks']} ticks late; its recording, run again: {replay}",
    ]
    wrong = [name for name, client in outcome.clients.items() if not client["agreed"]]
    wrong += [name for name, same in outcome.recorded_hashes.items() if not same and name not in wrong]
    if wrong:
        lines.append(f"NOT EQUAL: {', '.join(wrong)} differed from the server; the logs in {out} say where")
    elif not replay.ok:
        lines.append("NOT EQUAL: the recording came out differently")
    else:
        checked = sum(client["hashes_checked"] for client in outcome.clients.values())
        lines.append(
            f"EQUAL: {' and '.join(outcome.clients)} agreed with the server bit for bit,"
            f" {checked} states of {checked}"
        )
    return "\n".join(lines)
