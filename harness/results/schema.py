"""The flat rows: which columns a report makes of a stored row, what they are called and of which kind they are.

A column is a leaf of harness/results/row.py. CSV, Parquet and every table use these names;
`reports.analysis.derive` and `reports.analysis.breaks` add the columns that follow from them.

An ordinary cell is one row of SCHEMA. A cell of a family of hard rays is one row of FAMILY and, for each of its
rungs, one of RUNG.
"""

from __future__ import annotations

import json
import types
import typing
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal, NotRequired

from harness.results.row import KINDS as KINDS
from harness.results.row import SAME_NAME, Leaf, Part, RungVerdict, StoredRow

Kind = Literal["text", "real", "whole", "flag", "json", "reals"]


@dataclass(frozen=True)
class Field:
    """One leaf and its column. `path` leads to its value in a cell's file; a value that is null or absent is None in
    the flat row, and an error where the field is `required`."""

    name: str  # the column's; empty where there is none
    kind: Kind
    path: tuple[str, ...]  # "[]" stands for every item of a list
    meaning: str
    required: bool = False

    @cached_property
    def inside(self) -> tuple[str, ...]:
        """The path of the object that holds the value."""
        return self.path[:-1]


def fields_of(declared: Any, path: tuple[str, ...] = (), within: str = "", prefix: str = "") -> Iterator[Field]:
    """Yield the leaves of a TypedDict of harness/results/row.py in its order, those of its objects where these stand.

    A list of objects is a leaf, and the leaves of its items follow it without columns.
    `within` says what the object at `path` is, `prefix` begins the names of its columns.
    """
    for name, hint in typing.get_type_hints(declared, include_extras=True).items():
        annotated = typing.get_args(hint)[0] if typing.get_origin(hint) is NotRequired else hint
        kind, note = _without_none(annotated.__origin__), annotated.__metadata__[0]
        here = (*path, name)
        if typing.is_typeddict(kind):
            part = note if isinstance(note, Part) else Part("", prefix="")
            yield from fields_of(kind, here, part.meaning, part.prefix)
            continue
        leaf = note if isinstance(note, Leaf) else Leaf(note)
        column = name if leaf.column == SAME_NAME else leaf.column
        meaning = f"{leaf.meaning} of {within}" if within else leaf.meaning
        yield Field(prefix + column if column else "", _kind(kind), here, meaning, leaf.always)
        if typing.get_origin(kind) is list and typing.is_typeddict(item := typing.get_args(kind)[0]):
            yield from (replace(field, name="", required=False) for field in fields_of(item, (*here, "[]")))


def _without_none(kind: Any) -> Any:
    """`kind` where it is one type or None: the type."""
    if typing.get_origin(kind) not in (types.UnionType, typing.Union):
        return kind
    (alone,) = (part for part in typing.get_args(kind) if part is not types.NoneType)
    return alone


def _kind(kind: Any) -> Kind:
    """How a column holds values of a type: numbers and texts as they are, lists of reals as lists, all else as JSON."""
    if typing.get_origin(kind) is Literal:
        return "text"
    return _KINDS.get(kind, "json")


_KINDS: dict[Any, Kind] = {str: "text", float: "real", int: "whole", bool: "flag", list[float]: "reals"}


def _of_plan(name: str, meaning: str, required: bool = False) -> Field:
    return Field(name, "text", (name,), meaning, required)


LEAVES: tuple[Field, ...] = tuple(fields_of(StoredRow))
_COLUMNS = [field for field in LEAVES if field.name]
_AFTER = [field.name for field in _COLUMNS].index("variant") + 1

RUN = _of_plan("run", "the name of the run", required=True)
BASELINE = _of_plan("baseline", "the method or variant that speed-ups are over")
SCHEMA: tuple[Field, ...] = (RUN, *_COLUMNS[:_AFTER], BASELINE, *_COLUMNS[_AFTER:])


def _derived(kind: Kind, **meanings: str) -> Iterator[Field]:
    return (Field(name, kind, (name,), meaning) for name, meaning in meanings.items())


DERIVED: tuple[Field, ...] = (
    *_derived(
        "real",
        mrays_per_s="millions of rays per second, by median_ms",
        frames_per_s="frames per second, by median_ms",
        baseline_ms="median_ms of the baseline beside it",
        speedup="the baseline's time over this one's, in the rounds that timed both, where both answer rightly",
        floor_ms="median_ms of the method null beside it, which measures the harness",
    ),
    *_derived("flag", floor_bound="whether the time is under twice floor_ms"),
    *_derived("real", peak_share="operations of the evaluations per second, over the device's measured peak"),
    *_derived("flag", peak_too_low="whether the row exceeds the measured peak, so that no share is told"),
    *_derived(
        "whole",
        wrong_rays="clear rays that were answered wrongly, of whatever kind",
        grazing_wrong_rays="grazing rays that were answered wrongly",
        drowned_wrong_rays="drowned rays that were answered wrongly",
    ),
    *_derived("flag", front="whether no other variant with all clear rays right is both faster and more exact"),
)


def _leaf(name: str) -> Field:
    """The leaf `name` of the row itself, as a column."""
    (found,) = (field for field in LEAVES if field.path == (name,))
    return replace(found, name=name)


_OF_FAMILY = "key slot family method variant parameters origin precision device status reason answers"
FAMILY: tuple[Field, ...] = (RUN, *map(_leaf, _OF_FAMILY.split()))

RUNG: tuple[Field, ...] = (
    _leaf("key"),
    Field("level", "whole", ("level",), "the place of the rung, 0, 1, … going harder", required=True),
    *fields_of(RungVerdict),
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
