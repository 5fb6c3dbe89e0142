"""Compute a row's times again from its samples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from harness.contract import plural
from harness.results import sources
from harness.running.rows import Samples, time_of
from harness.verifying.model import CannotTell, Wrong, differing

SLACK = 1e-12  # between versions of numpy
WORDED_BY = "harness/results/timings.py"


def times(row: Mapping[str, Any]) -> Iterator[Wrong]:
    """Yield what a row's times say otherwise than its samples. Raises CannotTell where there is none."""
    time, identity = row.get("time"), row["identity"]
    if not time:
        raise CannotTell("it has no times")
    budget = identity.get("budget")
    if not isinstance(budget, dict) or "wall_samples_ms" not in time:
        raise CannotTell("its identity names no budget, or its host's samples are not kept")
    samples, wall, rounds = time["samples_ms"], time["wall_samples_ms"], time["rounds"]
    sittings = time.get("sittings", [len(samples)])
    if sum(sittings) != len(samples) or min(sittings) < 1:
        yield Wrong("time.sittings", sittings, f"counts of {plural(len(samples), 'sample')}")
        return
    by_device = time["clock"] == "device"
    if not by_device:
        yield from differing("time.samples_ms", samples, wall)
    sitting = [number for number, count in enumerate(sittings) for _ in range(count)]
    stored = Samples(time["clock"], list(wall), list(samples) if by_device else [], list(rounds), sitting)
    seed, interval = budget["seed"], budget["interval"]
    again: Mapping[str, Any] = time_of(stored, time["batch"], time["session"], seed=seed, interval=interval)
    for name, found in again.items():
        if name in time and not (name.startswith("bootstrap") and not _same_numpy(identity)):
            if name == "warnings" and not _same_words(identity):
                found = found if len(found) != len(time[name]) else time[name]
            yield from differing(f"time.{name}", time[name], found, SLACK)


def _same_numpy(identity: Mapping[str, Any]) -> bool:
    """Tell whether the row was made by this numpy, whose generator the bootstrap draws by."""
    packages = identity.get("packages")
    return isinstance(packages, dict) and packages.get("numpy") == sources.packages()["numpy"]


def _same_words(identity: Mapping[str, Any]) -> bool:
    """Tell whether the row's warnings were worded by this version."""
    files = identity.get("methodology")
    return isinstance(files, dict) and files.get(WORDED_BY) == sources.hashes(WORDED_BY)[WORDED_BY]
