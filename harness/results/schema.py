"""Turn stored rows into flat rows: state each column's name, kind and meaning, and read its value.

A column is a leaf of harness/results/row.py. CSV, Parquet and every table use these names;
`reports.analysis.derive` and `reports.analysis.breaks` add the columns that follow from them.

An ordinary cell is one row of SCHEMA. A cell of a family of hard rays is one row of FAMILY and, for each of its
rungs, one of RUNG.
"""

from __future__ import annotations

import json
import marshal
import types
import typing
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, Literal, NotRequired

from harness.results import declared
from harness.results.declared import Check
from harness.results.row import KINDS as KINDS
from harness.results.row import SAME_NAME, Leaf, Part, RungVerdict, StoredRow, Times

Kind = Literal["text", "real", "whole", "flag", "json", "reals"]


@dataclass(frozen=True)
class Field:
    """State a leaf of a stored row, and its column.

    `path` leads to the leaf's value in a cell's file. A value that is null or absent is None in the flat row.
    """

    name: str  # the column's; empty where there is none
    kind: Kind
    path: tuple[str, ...]  # "[]" stands for every item of a list
    meaning: str
    stated: Any = None  # the leaf's type with its limits, which `check` holds values against
    always: bool = False  # whether every row has it

    @cached_property
    def check(self) -> Check:
        """Return what raises ValueError, which names the path, for a value that the leaf cannot hold."""
        return declared.checker(Any if self.stated is None else self.stated)


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
        always = leaf.always and len(here) == 1
        yield Field(prefix + column if column else "", _kind(kind), here, meaning, annotated, always)
        if typing.get_origin(kind) is list and typing.is_typeddict(item := typing.get_args(kind)[0]):
            yield from (replace(field, name="") for field in fields_of(item, (*here, "[]")))


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


_KINDS: dict[Any, Kind] = {str: "text", float: "real", int: "whole", bool: "flag", Times: "reals"}


def _of_plan(name: str, meaning: str) -> Field:
    """Make a column of texts that the plan states, not the row."""
    return Field(name, "text", (name,), meaning)


LEAVES: tuple[Field, ...] = tuple(fields_of(StoredRow))
_COLUMNS = [field for field in LEAVES if field.name]
_AFTER = [field.name for field in _COLUMNS].index("variant") + 1

RUN = _of_plan("run", "the name of the run")
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
    Field("level", "whole", ("level",), "the place of the rung, 0, 1, … going harder"),
    *fields_of(RungVerdict),
)


def flattener(fields: Sequence[Field]) -> Callable[[dict[str, Any]], tuple[Any, ...]]:
    """Make the function that returns the values of `fields` in a stored row, in the order of the fields.

    The row was held against its declaration (harness.results.agreement). A value that is null or absent is None.
    """
    columns = flattener_of_many(fields)
    return lambda row: tuple(column[0] for column in columns([row]))


def flattener_of_many(fields: Sequence[Field]) -> Callable[[Sequence[dict[str, Any]]], list[list[Any]]]:
    """Make the function that returns for each of `fields` its values in stored rows, as `flattener` says of one row."""
    paths = dict.fromkeys(field.path[:-1] for field in fields)
    wanted = [(field.path[:-1], field.path[-1], field.kind) for field in fields]

    def flatten(rows: Sequence[dict[str, Any]]) -> list[list[Any]]:
        objects = {path: [_object(row, path) for row in rows] for path in paths}
        return [_made([one.get(name) for one in objects[path]], kind) for path, name, kind in wanted]

    return flatten


def _made(values: list[Any], kind: Kind) -> list[Any]:
    """Return the values of leaves as a column of their kind holds them."""
    made = _MADE.get(kind)
    if made is None or (kind == "real" and set(map(type, values)) <= _REAL):  # they are as they should be
        return values
    return [value if value is None else made(value) for value in values]


def _object(row: dict[str, Any], path: tuple[str, ...]) -> dict[str, Any]:
    """Return the object at `path`; an empty one where there is none."""
    found = row
    for name in path:
        found = found.get(name) or _NOTHING
    return found


@lru_cache(maxsize=4096)  # most rows have what other rows have; equal bytes are of equal values
def _json_of(marshalled: bytes) -> str:
    """Return as JSON what marshal.dumps returned these bytes for."""
    return _ENCODE(marshal.loads(marshalled))


_ENCODE = json.JSONEncoder(sort_keys=True).encode
_NOTHING: dict[str, Any] = {}
_REAL = {float, type(None)}
_MADE: dict[Kind, Callable[[Any], Any]] = {  # other values are columns' as they are
    "real": float,
    "json": lambda value: _json_of(marshal.dumps(value)),
    "reals": lambda values: list(map(float, values)),
}
