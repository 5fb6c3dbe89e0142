"""Make rows that a test made up complete, and refuse those that contradict themselves, as reading a row does."""

from __future__ import annotations

import copy
import json
import types
import typing
from typing import Any

from harness.results import agreement
from harness.results.row import Leaf, Part, StoredRow, Time

PERCENTILES = ("max", "p999", "p99", "p50")
PARTS = ("time", "accuracy", "environment", "family", "rungs")  # null where a row has them not, in every version


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


def oldest(finished: dict[str, Any], kind: Any = StoredRow) -> dict[str, Any]:
    """Return a cell that has nothing but what rows of every version have: what a report cannot do without."""
    made: dict[str, Any] = {}
    for name, hint in typing.get_type_hints(kind, include_extras=True).items():
        notes = getattr(hint, "__metadata__", ())
        kept = any(isinstance(note, Leaf | Part) and note.always for note in notes) or name in PARTS
        value, inner = finished.get(name), _object_of(hint)
        if not kept or name not in finished:
            continue
        if inner and isinstance(value, list):
            made[name] = [oldest(item, inner) for item in value]
        else:
            made[name] = oldest(value, inner) if inner and isinstance(value, dict) else value
    return made | ({"format": finished["format"]} if kind is StoredRow else {})


def _object_of(hint: Any) -> Any:
    """Return the TypedDict within a type; None where there is none."""
    return hint if typing.is_typeddict(hint) else next(filter(None, map(_object_of, typing.get_args(hint))), None)


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


def stated(finished: dict[str, Any]) -> dict[str, Any]:
    """Return a cell as its file has it, with the quantiles that a test left out, each as large as the next higher one.

    Nothing that a test stated is changed. Raises ValueError where the cell contradicts itself, since no such row is
    read: what the test says of it would not be tried.
    """
    made: dict[str, Any] = json.loads(json.dumps(finished))
    parts = (made["accuracy"] or {}).items()
    for quantiles in (part for name, part in parts if isinstance(part, dict) and name != "stages"):
        most = quantiles.get("max", max((v for v in quantiles.values() if v is not None), default=None))
        for name in PERCENTILES:
            most = quantiles.setdefault(name, most)
    agreement.check(made, "")
    return made
