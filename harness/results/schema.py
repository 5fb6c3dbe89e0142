"""Turn stored rows into flat rows: state each column's name, kind and meaning, and read its value.

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
    """State a leaf of a stored row, and its column.

    `path` leads to the leaf's value in a cell's file. A value that is null or absent is None in the flat row, and an
    error where the field is `required`.
    """

    name: str  # the column's; empty where there is none
    kind: Kind
    path: tuple[str, ...]  # "[]" stands for every item of a list
    meaning: str
    required: bool = False

    @cached_property
    def inside(self) -> tuple[str, ...]:
        """Return the path of the object that holds the value."""
        return self.path[:-1]


def fields_of(declared: Any, path: tuple[str, ...] = (), within: str = "", prefix: str = "") -> Iterator[Field]:
    """Yield the leaves of a TypedDict of harness/results/row.py, in the order in which they are declared.

    In place of an object its own leaves are yielded. A list of objects is a leaf, and the leaves of its items follow
    it, without columns. `within` is the meaning of the object at `path`; the names of its columns begin with `prefix`.
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
    """Return the type T of a union `T | None`, and any other type as it is."""
    if typing.get_origin(kind) not in (types.UnionType, typing.Union):
        return kind
    (alone,) = (part for part in typing.get_args(kind) if part is not types.NoneType)
    return alone


def _kind(kind: Any) -> Kind:
    """Return the kind of the column that holds values of a type.

    Columns hold texts, numbers, truth values and lists of reals as such, and everything else as JSON.
    """
    if typing.get_origin(kind) is Literal:
        return "text"
    return _KINDS.get(kind, "json")


_KINDS: dict[Any, Kind] = {str: "text", float: "real", int: "whole", bool: "flag", list[float]: "reals"}


def _of_plan(name: str, meaning: str, required: bool = False) -> Field:
    """Make a column of texts that the plan states, not the row."""
    return Field(name, "text", (name,), meaning, required)


LEAVES: tuple[Field, ...] = tuple(fields_of(StoredRow))
_COLUMNS = [field for field in LEAVES if field.name]
_AFTER = [field.name for field in _COLUMNS].index("variant") + 1

RUN = _of_plan("run", "the name of the run", required=True)
BASELINE = _of_plan("baseline", "the method or variant that speed-ups are over")
SCHEMA: tuple[Field, ...] = (RUN, *_COLUMNS[:_AFTER], BASELINE, *_COLUMNS[_AFTER:])


def _derived(kind: Kind, **meanings: str) -> Iterator[Field]:
    """Make columns of one kind that reports derive, by their names."""
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
    """Return the leaf `name` of the row itself, as a column of that name."""
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
    """Return the values of `fields` in a stored row, in the order of the fields.

    A value that is null or absent is None. Raises ValueError, which names the field, for the first value that is of
    another kind, and for the first required one that is missing.
    """
    around: dict[tuple[str, ...], Any] = {(): document}  # what was found on the way is shared by neighbouring fields
    return tuple(_value(field, around) for field in fields)


def _object(path: tuple[str, ...], around: dict[tuple[str, ...], Any]) -> Any:
    """Return the object at `path`, or None where there is none; `around` keeps what was found.

    Raises ValueError where something other than an object stands there.
    """
    if path not in around:
        outer = _object(path[:-1], around)
        value = None if outer is None else outer.get(path[-1])
        if value is not None and not isinstance(value, dict):
            raise ValueError(f"{'.'.join(path)} is no object")
        around[path] = value
    return around[path]


def _value(field: Field, around: dict[tuple[str, ...], Any]) -> Any:
    """Return a field's value. Raises ValueError where it is of another kind, or required and missing."""
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
    """Make the reader of values that are of one type exactly."""

    def read(value: Any) -> Any:
        """Return the value. Raises TypeError where it is of another type."""
        if type(value) is not kind:
            raise TypeError
        return value

    return read


def _real(value: Any) -> float:
    """Read a number as a float. Raises TypeError for anything else."""
    if type(value) not in (int, float):
        raise TypeError
    return float(value)


def _whole(value: Any) -> int:
    """Read a whole number. Raises TypeError for anything else, and OverflowError where 64 bits cannot hold it."""
    if type(value) is not int:
        raise TypeError
    if abs(value) >= 2**63:
        raise OverflowError
    return value


def _reals(value: Any) -> list[float]:
    """Read a list of numbers as floats. Raises TypeError for anything else."""
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
