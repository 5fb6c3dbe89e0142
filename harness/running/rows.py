"""Build the row that is stored of a cell from what the cell left behind."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

from harness.contract import CellStatus, Method, Surface
from harness.devices.messages import Warmed
from harness.experiment.kinds import of_method
from harness.experiment.plan import Planned
from harness.kernels.costs import operations_per_evaluation
from harness.results import timings
from harness.results.begun import Sample, counts
from harness.results.row import Accuracy, Build, CellRow, RungVerdict, Time
from surfaces.model import domain_text
from surfaces.proofs import extent

FIGURES = ("time", "build", "accuracy", "rungs")  # parts of a row that hold what was found


@dataclass(eq=False)
class Samples:
    """Hold the timed repetitions of one cell in the order in which they were taken; times are in ms for one frame."""

    clock: str  # the device's clock that is to be believed: "device" or "wall"
    wall_ms: list[float] = field(default_factory=list)
    device_ms: list[float] = field(default_factory=list)  # of the device's own clock; fewer where it did not always say
    rounds: list[int] = field(default_factory=list)  # the round of each sample, so that cells of one run can be paired
    sittings: list[int] = field(default_factory=list)  # the sitting of each sample

    def add(self, sample: Sample, round_number: int, sitting: int) -> None:
        """Keep one repetition: the time of a frame, in the mean over those that were drawn in a row."""
        wall_ms, device_ms, _ = sample
        self.wall_ms.append(wall_ms)
        if device_ms is not None:
            self.device_ms.append(device_ms)
        self.rounds.append(round_number)
        self.sittings.append(sitting)

    @property
    def by_device(self) -> bool:
        """Tell whether times are by the device's own clock: it is believed, and gave a time for every sample."""
        return self.clock == "device" and len(self.device_ms) == len(self.wall_ms)

    @property
    def times(self) -> list[float]:
        """Return the times that count, in ms, by the clock that `by_device` names."""
        return self.device_ms if self.by_device else self.wall_ms


@dataclass(frozen=True, eq=False)
class Left:
    """Hold the parts of a row that a cell which was tried left behind; None for a part that it did not get to."""

    build: Build
    seconds: float  # of checking, building and timing
    time: Time | None = None
    accuracy: Accuracy | None = None
    rungs: list[RungVerdict] | None = None


def row_of(
    planned: Planned,
    method: Method,
    status: CellStatus,
    reason: str | None,
    left: Left | None,
    environment: Mapping[str, Any],
) -> CellRow:
    """Build the row of a cell that ended now; `left` is None for one that was skipped or not tried.

    `environment` tells the project's `commit`, whether it is `dirty`, and the `machine` (running.environment.describe).
    """
    cell, own = planned.cell, planned.kind.facts(planned.cell)
    programs = ((planned.timed,) if planned.timed else ()) + planned.checks
    alone = cell.scene is None and planned.kind.listed == "cells"
    return {
        "key": planned.key,
        "slot": cell.slot,
        "comparison": cell.comparison,
        "method": cell.variant.method,
        "variant": cell.caster,
        "parameters": dict(cell.variant.parameters),
        "surface": cell.surface.name,
        "surface_title": cell.surface.title,
        "surface_group": cell.surface.group,
        "formula": cell.surface.formula,
        "degree": cell.surface.degree,
        "domain": domain_text(cell.surface.domain) if alone else None,
        "extent": extent.remark(cell.surface) if alone else None,
        "view": cell.view.name,
        "view_set": cell.view.set,
        "camera": own["camera"],
        "size": cell.size,
        "samples_per_pixel": cell.samples_per_pixel,
        "precision": cell.precision,
        "stage": cell.stage,
        "device": cell.device,
        "answers": method.answers,
        "casts": method.casts,
        "prepass": cell.prepass,
        "origin": of_method(method).told_origin(cell.origin),
        "proxy": own["proxy"],
        "normal": own["normal"],
        "pixel_tolerance": own["pixel_tolerance"],
        "scene": cell.scene.family if cell.scene else None,
        "instances": cell.scene.instances if cell.scene else None,
        "status": status.value,
        "reason": reason,
        "time": left.time if left else None,
        "build": left.build if left else None,
        "accuracy": left.accuracy if left else None,
        "family": cell.family,
        "rungs": left.rungs if left else None,
        "arrays": None,
        "operations": _operations(cell.surface) if left else None,
        "evaluation_operations": operations_per_evaluation(cell.surface, method.needs) if left else None,
        "program": {"hash": programs[0].hash} if programs else None,
        "environment": {
            "commit": environment["commit"],
            "dirty": environment["dirty"],
            "machine": environment["machine"],
            "started": datetime.now(UTC).isoformat(timespec="seconds"),
        },
        "seconds": left.seconds if left else 0.0,
        "identity": planned.identity,
    }


def time_of(samples: Samples, batch: int, session: str, *, seed: int, interval: float) -> Time:
    """Sum up timed repetitions of `batch` frames each, taken in the interleaved `session`.

    `seed` is the bootstrap's; `interval` is the share of the median within which its interval is to lie. Raises
    ValueError for no samples.
    """
    median, lower, upper, _ = timings.median_interval(samples.times)
    steady, sittings = timings.steadiness(samples.times), counts(samples.sittings)
    bootstrap_lower, bootstrap_upper = timings.bootstrap_interval(samples.times, seed)
    return {
        "clock": "device" if samples.by_device else "wall",
        "samples_ms": samples.times,
        "wall_samples_ms": samples.wall_ms,
        "rounds": samples.rounds,
        "session": session,
        "sittings": sittings,
        "batch": batch,
        "median_ms": median,
        "lower_ms": lower,
        "upper_ms": upper,
        "bootstrap_lower_ms": bootstrap_lower,
        "bootstrap_upper_ms": bootstrap_upper,
        "narrow": timings.is_narrow(samples.times, interval),
        "overhead_share": timings.overhead(samples.wall_ms, samples.device_ms) if samples.by_device else None,
        "drift_share": steady["drift_share"],
        "drift_chance": steady["drift_chance"],
        "spread_share": steady["spread_share"],
        "outliers": steady["outliers"],
        "warnings": steady["warnings"] + timings.sitting_warnings(samples.times, sittings),
    }


def without_figures(row: Mapping[str, Any], problem: str) -> dict[str, Any]:
    """Return a row that cannot be stored as a failed one, which says why: without its figures, and with None elsewhere.

    `problem` is said where every number of the row is finite.
    """
    wrong = next(_not_finite(row), None)
    reason = f"a figure of its row is not finite: {wrong}" if wrong else f"its row cannot be stored: {problem}"
    kept = {name: None if name in FIGURES else _stored(value) for name, value in row.items()}
    return {**kept, "status": CellStatus.FAILED.value, "reason": reason}


def _not_finite(value: object, place: str = "") -> Iterator[str]:
    """Yield each number in a value that is not finite, with the names that lead to it."""
    if isinstance(value, float) and not math.isfinite(value):
        yield f"{place} is {value:g}"
    elif isinstance(value, Mapping):
        for name, item in value.items():
            yield from _not_finite(item, f"{place}.{name}" if place else str(name))
    elif isinstance(value, list | tuple):
        for item in value:
            yield from _not_finite(item, place)


def _stored(value: Any) -> Any:
    """Return a value as a file can hold it: None in the place of what it cannot."""
    if isinstance(value, Mapping):
        return {str(name): _stored(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_stored(item) for item in value]
    finite = not isinstance(value, float) or math.isfinite(value)
    return value if finite and isinstance(value, str | int | float | None) else None


def build_of(warmed: Warmed | None, checked_ms: float) -> Build:
    """Say what building took: of the frame where one was `warmed`, else of the checked programs, `checked_ms` alone."""
    return {
        "compile_ms": warmed.compile_ms if warmed else checked_ms,
        "upload_ms": warmed.upload_ms if warmed else None,
        "readback_ms": warmed.readback_ms if warmed else None,
        "bytes": warmed.bytes if warmed else None,
    }


def _operations(surface: Surface) -> dict[str, int]:
    """Count the operations of a surface's formula, by kind."""
    import surfaces

    return dict(surfaces.operations(surface))
