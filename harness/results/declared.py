"""Hold what was read from a file against its declaration: a TypedDict, whose types and limits say what a value can be.

`Annotated[float, "the time, ms", POSITIVE]` states a limit. Without one a whole number is a count, which is not
negative and which 64 bits hold, and every other number is finite. `null` stands only where the type says `| None`.
Values that were not declared are left alone, since a newer version may have written them.
"""

from __future__ import annotations

import dataclasses
import sys
import types
import typing
from collections.abc import Callable, Mapping
from typing import Any, Literal, NotRequired

from harness.limits import OneOf, Within

Check = Callable[[Any, str], None]  # of a value and its path; raises ValueError, which names the path
Rule = Callable[[dict[str, Any]], str | None]  # says how an object contradicts itself, None where it does not
Needed = Callable[[Any], bool]  # tells by a leaf's notes whether it must be there
MOST = sys.float_info.max
COUNT = (0, 2**63 - 1)
FINITE = (-MOST, MOST)
POSITIVE = Within(sys.float_info.min, MOST, "{value} is not positive")
NOT_NEGATIVE = Within(0.0, MOST, "{value} is negative")
SHARE = Within(0.0, 1.0)
_IDEAS = {int: "count", float: "finite number"}
_NOUNS = {str: "text", int: "whole number", float: "number", bool: "truth value"}


def checker(kind: Any, rules: Mapping[Any, Rule] | None = None, needed: Needed = lambda _: True) -> Check:
    """Make the check of values that are declared to be of `kind`.

    `rules` says what must agree within an object, by its TypedDict; `needed` tells which leaves must be there, of those
    that are not NotRequired: all, if it is not given.
    """
    return _checker(kind, (), rules or {}, needed)


def _checker(kind: Any, notes: tuple[Any, ...], rules: Mapping[Any, Rule], needed: Needed) -> Check:
    origin, parts = typing.get_origin(kind), typing.get_args(kind)
    if origin is typing.Annotated:
        return _checker(parts[0], kind.__metadata__, rules, needed)
    if kind is Any:
        return lambda _value, _path: None
    if origin in (types.UnionType, typing.Union) and types.NoneType in parts:
        inner = _checker(typing.Union[*(part for part in parts if part is not types.NoneType)], notes, rules, needed)
        return lambda value, path: None if value is None else inner(value, path)
    if origin in (types.UnionType, typing.Union):
        return _one_of([_checker(part, notes, rules, needed) for part in parts])
    if origin is Literal:
        return _limited(_plain(str), OneOf(parts))
    if origin is list or (origin is tuple and parts[-1] is ...):
        numbers = _simple(parts[0])
        return _list(_checker(parts[0], (), rules, needed), numbers)
    if origin is tuple:
        return _tuple([_checker(part, (), rules, needed) for part in parts])
    if origin is dict:
        return _dict(_checker(parts[1], (), rules, needed))
    if typing.is_typeddict(kind):
        return _object(kind, rules, needed)
    check = _plain(kind, next((note for note in notes if isinstance(note, Within)), None))
    limit = next((note for note in notes if isinstance(note, OneOf)), None)
    return check if limit is None else _limited(check, limit)


def _one_of(checks: list[Check]) -> Check:
    """Check a value that is of one of several kinds."""

    def check(value: Any, path: str) -> None:
        for one in checks:
            try:
                return one(value, path)
            except ValueError as error:
                wrong = error
        raise wrong

    return check


def _limited(inner: Check, limit: OneOf) -> Check:
    def check(value: Any, path: str) -> None:
        inner(value, path)
        if broken := limit.broken(value):
            raise ValueError(f"{path}: {broken:.200}")

    return check


def _range(kind: type, within: Within | None) -> tuple[float, float] | None:
    """Return the least and the largest value of a kind; None where it has none."""
    if kind not in (int, float):
        return None
    return (within.low, within.high) if within else COUNT if kind is int else FINITE


def _plain(kind: type, within: Within | None = None) -> Check:
    """Check a text, a number or a truth value."""
    kinds, ends = ((int, float) if kind is float else (kind,)), _range(kind, within)

    def check(value: Any, path: str) -> None:
        if type(value) not in kinds:
            raise ValueError(f"{path} is no {_NOUNS[kind]}: {value!r:.40}")
        if ends is not None and not ends[0] <= value <= ends[1]:
            finite = kind is int or -MOST <= value <= MOST
            broken = within.broken(value) if within and finite else f"{value!r:.40} is no {_IDEAS[kind]}"
            raise ValueError(f"{path}: {broken:.200}")

    return check


def _list(item: Check, numbers: tuple[tuple[Any, ...], float, float] | None = None) -> Check:
    """Check a list; of `numbers`, as `_simple` returns them, all at once, which is fast."""

    def check(value: Any, path: str) -> None:
        if type(value) is not list:
            raise ValueError(f"{path} is no list: {value!r:.40}")
        alike = numbers and value and set(numbers[0]).issuperset(map(type, value))
        if alike and numbers and numbers[1] <= min(value) and max(value) <= numbers[2]:
            return
        inside = f"{path}[]"
        for one in value:
            item(one, inside)

    return check


def _tuple(items: list[Check]) -> Check:
    def check(value: Any, path: str) -> None:
        if type(value) is not list or len(value) != len(items):
            raise ValueError(f"{path} is no list of {len(items)}: {value!r:.40}")
        for item, one in zip(items, value, strict=True):
            item(one, f"{path}[]")

    return check


def _dict(item: Check) -> Check:
    def check(value: Any, path: str) -> None:
        if type(value) is not dict:
            raise ValueError(f"{path} is no object: {value!r:.40}")
        for name, one in value.items():
            item(one, f"{path}.{name:.40}")

    return check


def _object(kind: Any, rules: Mapping[Any, Rule], needed: Needed) -> Check:
    """Check an object of a TypedDict: most of its leaves are plain and are looked at in one loop, which is fast."""
    checks: dict[str, Check] = {}
    simple: dict[str, tuple[tuple[Any, ...], float, float]] = {}
    exact: dict[str, Any] = {}  # texts and truth values of which nothing else is stated
    missing: list[str] = []
    for name, stated in typing.get_type_hints(kind, include_extras=True).items():
        optional = typing.get_origin(stated) is NotRequired
        hint = typing.get_args(stated)[0] if optional else stated
        notes = getattr(hint, "__metadata__", ())
        if not optional and needed(notes):
            missing.append(name)
        checks[name] = _checker(hint, (), rules, needed)
        if ends := _simple(hint):
            simple[name] = ends
        plain = hint if hint in (str, bool) else getattr(hint, "__origin__", None)
        if plain in (str, bool) and not any(isinstance(note, OneOf) for note in notes):
            exact[name] = plain
    rule = rules.get(kind)

    def check(value: Any, path: str) -> None:
        if type(value) is not dict:
            raise ValueError(f"{path or 'it'} is no object: {value!r:.40}")
        for name, one in value.items():
            if type(one) is exact.get(name):
                continue
            ends = simple.get(name)
            if ends is not None and type(one) in ends[0] and ends[1] <= one <= ends[2]:
                continue
            inner = checks.get(name)
            if inner is not None:
                inner(one, f"{path}.{name}" if path else name)
        for name in missing:
            if name not in value:
                raise ValueError(f"{path}{'.' * bool(path)}{name} is missing")
        broken = rule(value) if rule else None
        if broken:
            raise ValueError(f"{path}: {broken}" if path else broken)

    return check


def _simple(hint: Any) -> tuple[tuple[Any, ...], float, float] | None:
    """Return types, least and largest value of a number; None for what is no number alone."""
    notes, kind = getattr(hint, "__metadata__", ()), getattr(hint, "__origin__", hint)
    united = typing.get_origin(kind) in (types.UnionType, typing.Union)
    parts = [part for part in typing.get_args(kind) if part is not types.NoneType] if united else [kind]
    ends = _range(parts[0], next((note for note in notes if isinstance(note, Within)), None))
    if len(parts) > 1 or ends is None:
        return None
    return ((int, float) if parts[0] is float else (int,)), *ends


def of_dataclass(kind: type) -> Check:
    """Make the check of an object that has a member for each field of a dataclass, and no other.

    Raises ValueError, as every check, where it has others or lacks one.
    """
    hints = typing.get_type_hints(kind, include_extras=True)
    members = {field.name: _checker(hints[field.name], (), {}, lambda _: True) for field in dataclasses.fields(kind)}

    def check(value: Any, path: str) -> None:
        if type(value) is not dict or value.keys() != members.keys():
            raise ValueError(f"{path or 'it'} has other members than {', '.join(members)}")
        for name, member in members.items():
            member(value[name], name)

    return check
