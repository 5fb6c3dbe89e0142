"""The flat rows: which values of a cell's file a report uses, what they are called and of which kind they are.

A name is the last part of the value's path in the file, prefixed only where two would collide. CSV, Parquet and
every table use these names; `reports.analysis.derive` and `reports.analysis.breaks` add the columns that follow from
them.

An ordinary cell is one row of SCHEMA. A cell of a family of hard rays is one row of FAMILY and, for each of its
rungs, one of RUNG.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

Kind = Literal["text", "real", "whole", "flag", "json", "reals"]


@dataclass(frozen=True)
class Field:
    """One column. `path` leads to its value in a cell's file; a value that is null or absent is None in the row."""

    name: str
    kind: Kind
    path: tuple[str, ...] = ()
    required: bool = False

    @cached_property
    def inside(self) -> tuple[str, ...]:
        """The path of the object that holds the value."""
        return self.path[:-1]


def _fields(kind: Kind, names: str, at: str = "", prefix: str = "", required: bool = False) -> Iterator[Field]:
    for name in names.split():
        yield Field(prefix + name, kind, (*at.split("."), name) if at else (name,), required)


KINDS = ("misses", "false_hits", "exhausted", "wrong_root", "invalid")  # of wrong rays; older rows lack the last
_PERCENTILES = "max p999 p99 p50"
UNITS = (
    *("error", "relative_error", "feature_error", "pixel_error", "ulp_error"),
    *("condition_ratio", "normal_error_degrees", "residual"),
)

SCHEMA: tuple[Field, ...] = (
    *_fields("text", "run key slot comparison method variant", required=True),  # `run` is the plan's name
    *_fields("text", "baseline"),  # the plan's: the method or variant that speed-ups are over
    *_fields("json", "parameters"),
    *_fields("text", "surface surface_title", required=True),
    *_fields("text", "formula"),
    *_fields("whole", "degree"),
    *_fields("text", "view", required=True),
    *_fields("text", "view_set"),
    *_fields("real", "azimuth elevation fov distance", at="camera"),
    *_fields("whole", "size samples_per_pixel", required=True),
    *_fields("text", "precision stage device status", required=True),
    *_fields("text", "reason"),
    *_fields("flag", "answers", required=True),
    *_fields("text", "casts prepass proxy normal scene"),
    *_fields("text", "origin"),  # of rays; null for beams and triangles, and in older rows
    *_fields("real", "pixel_tolerance"),
    *_fields("whole", "instances"),
    *_fields("text", "clock", at="time"),
    *_fields("real", "median_ms lower_ms upper_ms overhead_share", at="time"),
    *_fields("real", "bootstrap_lower_ms bootstrap_upper_ms drift_share drift_chance spread_share", at="time"),
    *_fields("whole", "outliers", at="time"),
    *_fields("json", "warnings", at="time"),
    *_fields("flag", "narrow", at="time"),
    *_fields("whole", "batch", at="time"),
    *_fields("reals", "samples_ms", at="time"),
    *_fields("json", "rounds", at="time"),
    *_fields("text", "session", at="time"),
    *_fields("real", "compile_ms upload_ms readback_ms", at="build"),
    *_fields("whole", "bytes", at="build"),
    *_fields("whole", "size rays", at="accuracy", prefix="accuracy_"),
    *_fields("whole", "domain_rays", at="accuracy"),
    *_fields("whole", "fragments fragments_discarded pixels_drawn other_instance", at="accuracy"),
    *_fields("whole", "truth_hits truth_misses undecided grazing drowned judged", at="accuracy"),
    *_fields("real", "grazing_margin scene_radius domain_radius", at="accuracy"),
    *_fields("whole", " ".join(KINDS), at="accuracy"),
    *_fields("whole", " ".join(f"grazing_{kind}" for kind in KINDS), at="accuracy"),
    *_fields("whole", " ".join(f"drowned_{kind}" for kind in KINDS), at="accuracy"),
    *(field for unit in UNITS for field in _fields("real", _PERCENTILES, at=f"accuracy.{unit}", prefix=f"{unit}_")),
    *_fields("whole", "beam_only", at="accuracy"),  # hits of what the pixel's beam sees and its ray passes by
    *_fields("real", "evaluations_mean evaluations_max prepass_evaluations_mean", at="accuracy"),
    *_fields("json", "lanes", at="accuracy"),  # of beams: what each level's work items spend and leave idle
    *_fields("text", "arrays"),
    *_fields("json", "operations"),
    *_fields("whole", "evaluation_operations"),
    *_fields("text", "hash", at="program", prefix="program_"),
    *_fields("text", "started commit", at="environment"),
    *_fields("json", "identity"),
)

DERIVED: tuple[Field, ...] = (
    *_fields("real", "mrays_per_s frames_per_s baseline_ms speedup floor_ms"),
    *_fields("flag", "floor_bound"),
    *_fields("real", "peak_share"),
    *_fields("flag", "peak_too_low"),
    *_fields("whole", "wrong_rays grazing_wrong_rays drowned_wrong_rays"),
    *_fields("flag", "front"),
)


FAMILY: tuple[Field, ...] = (
    *_fields("text", "run key slot family method variant", required=True),
    *_fields("json", "parameters"),
    *_fields("text", "origin"),
    *_fields("text", "precision device status", required=True),
    *_fields("text", "reason"),
    *_fields("flag", "answers", required=True),
)

RUNG: tuple[Field, ...] = (
    *_fields("text", "key", required=True),
    *_fields("whole", "level", required=True),  # 0, 1, … going harder
    *_fields("real", "parameter", required=True),
    *_fields("whole", "rays decided right misses false_hits exhausted wrong_root", required=True),
    *_fields("whole", "invalid"),
    *_fields("whole", "undecidable undecidable_right undecided", required=True),
    *_fields("real", "max_error worst_ratio"),
)


def flatten(fields: Sequence[Field], document: dict[str, Any]) -> tuple[Any, ...]:
    """The values of `fields`, in their order; a ValueError names the first that is missing or of another kind."""
    around: dict[tuple[str, ...], Any] = {(): document}  # what was found on the way is shared by neighbouring fields
    return tuple(_value(field, around) for field in fields)


def _object(path: tuple[str, ...], around: dict[tuple[str, ...], Any]) -> Any:
    """The object at `path`, or None; found and checked once."""
    if path not in around:
        outer = _object(path[:-1], around)
        value = None if outer is None else outer.get(path[-1])
        if value is not None and not isinstance(value, dict):
            raise ValueError(f"{'.'.join(path)} is no object")
        around[path] = value
    return around[path]


def _value(field: Field, around: dict[tuple[str, ...], Any]) -> Any:
    found = _object(field.inside, around)
    value = None if found is None else found.get(field.path[-1])
    if value is None:
        if field.required:
            raise ValueError(f"{'.'.join(field.path)} is missing")
        return None
    try:
        return _READERS[field.kind](value)
    except (TypeError, OverflowError) as error:
        raise ValueError(f"{'.'.join(field.path)} is no {_NOUNS[field.kind]}: {value!r:.40}") from error


def _exactly(kind: type) -> Callable[[Any], Any]:
    def read(value: Any) -> Any:
        if type(value) is not kind:
            raise TypeError
        return value

    return read


def _real(value: Any) -> float:
    if type(value) not in (int, float):
        raise TypeError
    return float(value)


def _whole(value: Any) -> int:
    if type(value) is not int:
        raise TypeError
    if abs(value) >= 2**63:
        raise OverflowError
    return value


def _reals(value: Any) -> list[float]:
    if type(value) is not list or not {float, int}.issuperset(map(type, value)):
        raise TypeError
    return list(map(float, value))


_READERS: dict[Kind, Callable[[Any], Any]] = {
    "text": lambda value: _exactly(str)(value).encode(errors="replace").decode(),  # half a surrogate pair is no text
    "real": _real,
    "whole": _whole,
    "flag": _exactly(bool),
    "json": json.JSONEncoder(sort_keys=True).encode,
    "reals": _reals,
}
_NOUNS: dict[Kind, str] = {
    "text": "text",
    "real": "number",
    "whole": "whole number",
    "flag": "truth value",
    "json": "object",
    "reals": "list of numbers",
}
