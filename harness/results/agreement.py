"""Hold a stored row against itself: what its declaration says of several leaves together.

A row that contradicts itself was damaged or edited, and none of its figures is used.
"""

from __future__ import annotations

import re
from typing import Any

from harness.contract import plural
from harness.results import declared
from harness.results.row import KINDS, Accuracy, Leaf, Part, Quantiles, RungVerdict, StoredRow, Time

_ARRAYS = re.compile(r"arrays/[0-9A-Za-z]+\.npz")
ROUNDING = 1e-9  # the share by which a median that was computed anew may differ


def _time(time: dict[str, Any]) -> str | None:
    """Say where the times and what they say together disagree."""
    samples = time.get("samples_ms")
    if samples is None:
        return None
    if not samples:
        return "it has no samples"
    for name in ("wall_samples_ms", "rounds"):
        if name in time and len(time[name]) != len(samples):
            return f"{name} has {plural(len(time[name]), 'item')}, samples_ms {len(samples)}"
    if len(set(time.get("rounds", ()))) != len(time.get("rounds", ())):
        return "a round stands twice in rounds"
    ordered, count = sorted(samples), len(samples)
    median = 0.5 * ordered[(count - 1) // 2] + 0.5 * ordered[count // 2]
    if "median_ms" in time and abs(time["median_ms"] - median) > ROUNDING * median:
        return f"median_ms is {time['median_ms']:.6g}, but the median of samples_ms is {median:.6g}"
    low, high = (1.0 - ROUNDING) * ordered[0], (1.0 + ROUNDING) * ordered[-1]
    for least, most in (("lower_ms", "upper_ms"), ("bootstrap_lower_ms", "bootstrap_upper_ms")):
        ends = (time.get(least, low), time.get(most, high))
        if not low <= ends[0] <= (1.0 + ROUNDING) * median or not (1.0 - ROUNDING) * median <= ends[1] <= high:
            return f"{least} and {most} do not lie around the median, within the samples"
    return None


def _quantiles(found: dict[str, Any]) -> str | None:
    """Say where quantiles do not rise, or some are there and others are not."""
    values = [found[name] for name in ("p50", "p99", "p999", "max") if name in found]
    there = [value for value in values if value is not None]
    if there and len(there) != len(values):
        return "some quantiles are null and others are not"
    return None if there == sorted(there) else "a higher quantile is less than a lower one"


def _accuracy(found: dict[str, Any]) -> str | None:
    """Say where the counts of rays disagree."""
    rays = found.get("rays")
    if rays is None:
        return None
    if "size" in found and found["size"] ** 2 != rays:
        return f"{rays} rays are not those of a square of {found['size']}"
    known = [found.get(name) for name in ("truth_hits", "truth_misses", "undecided")]
    if None not in known and sum(known) != rays:  # type: ignore[arg-type]
        return f"truth_hits, truth_misses and undecided add up to {sum(known)}, not to {rays}"  # type: ignore[arg-type]
    for kind in ("", "grazing_", "drowned_"):
        if sum(found.get(f"{kind}{name}", 0) for name in KINDS) > rays:
            return f"more rays are wrong than the {rays} that were checked"
    of_all = ("domain_rays", "grazing", "drowned", "judged", "beam_only")
    over = next((name for name in of_all if found.get(name, 0) > rays), None)
    return None if over is None else f"{over} is {found[over]}, of {rays} rays"


def _rung(rung: dict[str, Any]) -> str | None:
    """Say where the counts of a rung's rays disagree."""
    parts = sum(rung[name] for name in ("decided", "undecidable", "undecided"))
    if parts != rung["rays"]:
        return f"decided, undecidable and undecided add up to {parts}, not to {rung['rays']}"
    answered = rung["right"] + sum(rung.get(name, 0) for name in KINDS)
    if answered != rung["decided"]:
        return f"right and wrong rays add up to {answered}, not to {rung['decided']}"
    if rung.get("max_error") is not None and not rung["right"]:
        return "it has a largest error, and no ray was answered rightly"
    within = rung["undecidable_right"] <= rung["undecidable"]
    return None if within else "more undecidable rays are right than there are"


def _row(row: dict[str, Any]) -> str | None:
    """Say where a row's parts disagree."""
    if row.get("arrays") is not None and not _ARRAYS.fullmatch(row["arrays"]):
        return f"arrays is {row['arrays']!r:.40}, which names no file of arrays"
    if row.get("family") is None and row.get("rungs") is not None:
        return "it has rungs and no family"
    if row["status"] != "ok" and row.get("reason") is None:
        return f"its status is {row['status']}, without a reason"
    return None


RULES = {Time: _time, Quantiles: _quantiles, Accuracy: _accuracy, RungVerdict: _rung, StoredRow: _row}


def _always(notes: tuple[Any, ...]) -> bool:
    """Tell by a leaf's notes whether rows of every version have it."""
    return any(isinstance(note, (Leaf, Part)) and note.always for note in notes)


check = declared.checker(StoredRow, RULES, _always)  # of rows of every version
check_whole = declared.checker(StoredRow, RULES)  # of rows of this version, which have every leaf
