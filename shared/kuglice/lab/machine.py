"""What measured: machine, versions, date. A figure without them is hearsay."""

from __future__ import annotations

import os
import platform
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from kuglice import _core
from kuglice.version import VERSION

__all__ = ["Machine", "this_machine"]

VECTORS = ("sse4_2", "avx2", "fma", "bmi2", "avx512f")
NAMED = ("numpy", "scipy", "numba", "pymunk", "eclipse-zenoh")


@dataclass(frozen=True)
class Machine:
    """Where and with what."""

    processor: str
    cores: int
    vectors: str
    """The vector instructions that it has, used or not."""
    system: str
    versions: dict[str, str]
    flags: str
    """How the compiled step was built and run."""
    date: str

    def lines(self) -> list[str]:
        """For the footer of a picture and the head of a CSV."""
        listed = ", ".join(f"{name} {number}" for name, number in self.versions.items())
        machine = f"{self.processor}, {self.cores} cores, {self.system}"
        return [
            f"{machine}, {self.vectors}" if self.vectors else machine,
            listed,
            f"{self.flags}; {self.date}",
        ]

    def to_message(self) -> dict[str, object]:
        """Values that JSON knows."""
        return dict(vars(self))


def this_machine() -> Machine:
    """The one that runs this."""
    versions = {"kuglice": VERSION, "step": str(_core.STEP_VERSION), "python": platform.python_version()}
    for name in NAMED:
        try:
            versions[name] = version(name)
        except PackageNotFoundError:
            continue
    return Machine(
        processor=_processor(),
        cores=os.cpu_count() or 1,
        vectors=_vectors(),
        system=f"{platform.system()} {platform.machine()}",
        versions=versions,
        flags=_flags(),
        date=f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC, load {_load()}",
    )


def _flags() -> str:
    """Of the compiled step, whatever the environment says now."""
    build = _core.BUILD
    return (
        f"1 thread if a case says no more, f64, {build['rustc']}, {build['target']}"
        f" with {build['target_features'] or 'no features'}, opt-level {build['opt_level']},"
        f" RUSTFLAGS {build['flags'] or 'none'}"
    )


def _facts() -> dict[str, str]:
    """What Linux says of the first processor."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return {}
    lines = [line.partition(":") for line in text.split("\n\n")[0].splitlines()]
    return {name.strip(): value.strip() for name, _, value in lines}


def _vectors() -> str:
    """The vector instructions that the processor has, used or not."""
    has = set(_facts().get("flags", "").split())
    return " ".join(name for name in VECTORS if name in has)


def _processor() -> str:
    facts = _facts()
    name = facts.get("model name") or platform.processor() or platform.machine()
    clock = facts.get("cpu MHz")
    return f"{name} at {float(clock) / 1000:.1f} GHz" if clock and "GHz" not in name else name


def _load() -> str:
    """How many others ran at the time: times on a busy machine are upper bounds."""
    try:
        return f"{os.getloadavg()[0]:.1f}"
    except OSError:
        return "unknown"
