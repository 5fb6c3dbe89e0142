"""Make rows that a test made up agree with themselves, and complete, as stored rows must be."""

from __future__ import annotations

import copy
import statistics
import types
import typing
from typing import Any

from harness.results.row import StoredRow, Time

PERCENTILES = ("max", "p999", "p99", "p50")


def whole(finished: dict[str, Any], kind: Any = StoredRow) -> dict[str, Any]:
    """Return a cell with every leaf that a row of this version has, as a run stores it."""
    made = copy.deepcopy(finished)
    for name, hint in typing.get_type_hints(kind).items():
        if typing.get_origin(hint) is not typing.NotRequired and name not in made:
            made[name] = _blank(hint)
        inner = next((part for part in typing.get_args(hint) if typing.is_typeddict(part)), hint)
        if typing.is_typeddict(inner) and isinstance(made.get(name), dict):
            made[name] = whole(made[name], inner)
        elif typing.is_typeddict(inner) and isinstance(made.get(name), list):
            made[name] = [whole(item, inner) for item in made[name]]
    if kind is Time:
        made |= {"wall_samples_ms": made["samples_ms"]}
        made |= {"bootstrap_lower_ms": made["lower_ms"], "bootstrap_upper_ms": made["upper_ms"]}
    return made


def _blank(hint: Any) -> Any:
    """Return a value of a type that says nothing."""
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if types.NoneType in parts:
        return None
    if origin is typing.Literal:
        return parts[0]
    if typing.is_typeddict(hint):
        return whole({}, hint)
    return {float: 1.0}.get(hint, (origin or hint)())


def agreeing(finished: dict[str, Any]) -> dict[str, Any]:
    """Return a cell whose figures agree with each other, where a test changed some of them."""
    made = copy.deepcopy(finished)
    time, found = made["time"], made["accuracy"]
    if time:
        samples = time["samples_ms"]
        median = time["median_ms"] = statistics.median(samples)
        time["lower_ms"] = min(max(min(samples), time["lower_ms"]), median)
        time["upper_ms"] = max(min(max(samples), time["upper_ms"]), median)
    if found:
        for quantiles in (part for part in found.values() if isinstance(part, dict)):
            most = quantiles.get("max", max((v for v in quantiles.values() if v is not None), default=None))
            for name in PERCENTILES:
                own = quantiles.get(name)
                most = quantiles[name] = own if own is not None and most is not None and own < most else most
        found["truth_misses"] = found["rays"] - found["truth_hits"] - found["undecided"]
    return made
