"""State on a field itself what it may hold: `size: Annotated[int, Within(1, 4096)] = 128`.

A limit's `broken` says what is wrong with a value, or None where nothing is. harness.experiment.reading holds every
field of a config against its limits, and adds the field's name, the file and the line. What a caller of the Python
package or of a command states is held to the same limits by `hold` and `held`.
"""

from __future__ import annotations

import dataclasses
import math
import os
import types
import typing
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from numbers import Integral
from pathlib import Path
from typing import Any, Protocol

from surfaces.model import FirsthitError, beginning, is_number
from surfaces.words import LONGEST_NAME, name_problem, suggestion, unseen

_UNSEEN = r"\u0000-\u001f\u007f"  # control characters, as a schema's patterns name them


class Limit(Protocol):
    """Define a limit of a field: what stands beside the type in `Annotated`."""

    def broken(self, value: Any) -> str | None:
        """Say why a field cannot hold `value`; None where it can."""

    def keywords(self) -> dict[str, Any]:
        """Return what a JSON schema says of the value, of each item of a list, or of each key of a table."""


@dataclass(frozen=True)
class Within:
    """State that a number is finite and lies between `low` and `high`, both included; NaN lies nowhere.

    `words` is the text of the mistake; it may name {value}, {low} and {high}.
    """

    low: float
    high: float
    words: str = "{value} is outside [{low:g}, {high:g}]"

    def broken(self, value: float) -> str | None:
        if is_finite(value) and self.low <= value <= self.high:
            return None
        if isinstance(value, int) and not is_finite(value):  # it may have more digits than Python writes
            value = math.inf if value > 0 else -math.inf
        return self.words.format(value=value, low=self.low, high=self.high)

    def keywords(self) -> dict[str, Any]:
        stated = {"minimum": self.low, "maximum": self.high}
        return {word: bound for word, bound in stated.items() if math.isfinite(bound)}


@dataclass(frozen=True)
class OneOf:
    """State that a value, or every item of a list, is one of a few values."""

    values: tuple[str | int, ...]
    words: str = "{value!r} is not one of {values}"

    def broken(self, value: Any) -> str | None:
        for one in value if isinstance(value, list) else [value]:
            if one not in self.values:
                return self.words.format(value=one, values=", ".join(map(str, self.values)))
        return None

    def keywords(self) -> dict[str, Any]:
        return {"enum": list(self.values)}


@dataclass(frozen=True)
class Known:
    """State that the names in a list, or the keys of a table, are known.

    `names` is called when a config is read, since it may have to import what it lists. With `or_all`, the list may be
    ["all"] instead.
    """

    names: Callable[[], Iterable[str]]
    or_all: bool = False

    def broken(self, value: Iterable[str]) -> str | None:
        if self.or_all and value == ["all"]:
            return None
        known = list(self.names())
        unknown = next((name for name in value if name not in known), None)
        return None if unknown is None else f"unknown {unknown!r}; {suggestion(unknown, known)}"

    def keywords(self) -> dict[str, Any]:
        return {"enum": [*(["all"] if self.or_all else []), *self.names()]}


@dataclass(frozen=True)
class Named:
    """A name that is known, or none: an empty text. `names` is called when a config is read."""

    names: Callable[[], Iterable[str]]

    def broken(self, value: str) -> str | None:
        return Known(self.names).broken([value]) if value else None

    def keywords(self) -> dict[str, Any]:
        return {"enum": ["", *self.names()]}


@dataclass(frozen=True)
class Offered:
    """Names that an editor may offer for a text, or for the items of a list, which may be other texts too."""

    names: Callable[[], Iterable[str]]

    def broken(self, value: Any) -> None:
        del value

    def keywords(self) -> dict[str, Any]:
        return {"anyOf": [{"enum": list(self.names())}, {"type": "string"}]}


@dataclass(frozen=True)
class Distinct:
    """State that a list holds nothing twice. `names` gives what must differ, where it is not the items themselves."""

    names: Callable[[Any], Sequence[Any]] = list

    def broken(self, value: Any) -> str | None:
        seen = set()
        for name in self.names(value):
            if name in seen:
                return f"{name!r} is named twice"
            seen.add(name)
        return None

    def keywords(self) -> dict[str, Any]:
        return {}  # it is said of the list, see harness.schemas


@dataclass(frozen=True)
class Name:
    """State that a text, or each key of a table, can be a name (surfaces.words.name_problem).

    or_none: an empty text says that there is none
    """

    or_none: bool = False

    def broken(self, value: str | Iterable[str]) -> str | None:
        names = [value] if isinstance(value, str) else value
        return next((problem for name in names if name or not self.or_none if (problem := name_problem(name))), None)

    def keywords(self) -> dict[str, Any]:
        return {"maxLength": LONGEST_NAME, "pattern": f"^[^{_UNSEEN}/\\\\]{'*' if self.or_none else '+'}$"}


@dataclass(frozen=True)
class Line:
    """State that a text is one line of letters that can be seen, `most` of them at most."""

    most: int = 300

    def broken(self, value: str) -> str | None:
        if len(value) > self.most:
            return f"a text of {self.most:,} letters at most, not of {len(value):,}"
        bad = unseen(value)
        return None if bad is None else f"it holds {bad!a}: one line of letters and signs that can be seen"

    def keywords(self) -> dict[str, Any]:
        return {"maxLength": self.most, "pattern": f"^[^{_UNSEEN}]*$"}


@dataclass(frozen=True)
class FilePath(Line):
    """State that a text is a path that a file can have."""

    most: int = 800

    def broken(self, value: str) -> str | None:
        return super().broken(value) or (None if _is_path(value) else "no file can have such a name")


@dataclass(frozen=True)
class AtMost:
    """State that a text, a list or a table has so many letters, items or keys at most."""

    count: int

    def broken(self, value: Any) -> str | None:
        return f"{self.count:,} at most, not {len(value):,}" if len(value) > self.count else None

    def keywords(self) -> dict[str, Any]:
        return {}  # they are of a list's items, and this is of the list


def is_required(field: dataclasses.Field[Any]) -> bool:
    """Tell whether a field has no default."""
    return field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING


def is_finite(value: float) -> bool:
    """Tell whether a number is finite; a whole number that is too large for a float is not."""
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number of more than 308 digits
        return False


def hold(record: Any) -> None:
    """Hold each field of a dataclass to the kind and the limits that its annotation states, and make it plain.

    Numbers of numpy become numbers of Python. Raises FirsthitError, which names the field.
    """
    for name, kind in hints_of(record.__class__).items():
        object.__setattr__(record, name, held(name, getattr(record, name), kind))


def hints_of(record: type[Any]) -> dict[str, Any]:
    """Return the kind of each field of a dataclass, with its limits."""
    if record not in _HINTS:
        _HINTS[record] = typing.get_type_hints(record, include_extras=True)
    return _HINTS[record]


_HINTS: dict[type[Any], dict[str, Any]] = {}  # evaluating them takes longer than reading a table


def held(name: str, value: Any, kind: Any) -> Any:
    """Return `value` as a plain value of a kind.

    A kind is float, int, str, any other class, a Literal of words, a tuple of kinds or of any number of one kind, a
    union of one with None, or any of these Annotated with limits. A whole number may stand for a float, and stays
    whole. Raises FirsthitError, whose text begins with `name`, for a value of another kind or past its limits.
    """
    origin, parts = typing.get_origin(kind), typing.get_args(kind)
    if origin is typing.Annotated:
        plain = held(name, value, parts[0])
        for limit in parts[1:]:
            if problem := limit.broken(plain):
                raise FirsthitError(f"{name}: {problem}")
        return plain
    if origin in (types.UnionType, typing.Union):
        return None if value is None else held(name, value, next(k for k in parts if k is not type(None)))
    if origin is typing.Literal:
        return _word(name, value, parts)
    if origin is tuple and parts[1:] == (Ellipsis,):
        if not isinstance(value, Sequence) or isinstance(value, str):
            raise FirsthitError(f"{name} is a list, not {shown(value)}")
        return tuple(held(name, item, parts[0]) for item in value)
    if origin is tuple:
        if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != len(parts):
            raise FirsthitError(f"{name} needs {len(parts)} numbers, not {shown(value)}")
        return tuple(held(name, item, part) for item, part in zip(value, parts, strict=True))
    if kind in (float, int):
        return _plain(name, value, whole=kind is int)
    if not isinstance(value, kind):
        raise FirsthitError(f"{name} is a {'text' if kind is str else kind.__name__}, not {shown(value)}")
    return value


def checked_path(name: str, given: Any) -> Path:
    """Return the path that a caller gave. Raises FirsthitError, which names the argument, where it is none."""
    if not isinstance(given, str | Path):
        raise FirsthitError(f"{name} is a path, as a text or a pathlib.Path, not {shown(given)}")
    if not _is_path(given):
        raise FirsthitError(f"{name} is no path that a file can have: {shown(str(given))}")
    return Path(given)


def _is_path(given: str | Path) -> bool:
    """Tell whether a file can have this path: no file system has names of more than 255 bytes, or of zeros."""
    return not any(len(os.fsencode(part)) > 255 or "\0" in part for part in Path(given).parts)


def checked_names(name: str, given: Any) -> list[str]:
    """Return the names that a caller gave. Raises FirsthitError, which names the argument, for anything else."""
    if not isinstance(given, list | tuple) or not all(isinstance(one, str) for one in given):
        raise FirsthitError(f"{name} is a list of names, not {shown(given)}")
    return list(given)


def _word(name: str, value: Any, known: tuple[str, ...]) -> str:
    if not isinstance(value, str):
        raise FirsthitError(f"{name} is one of the texts {', '.join(map(repr, known))}, not {shown(value)}")
    if value not in known:
        raise FirsthitError(f"unknown {name} {value!r}; {suggestion(value, known)}")
    return value


def shown(value: object) -> str:
    """Write a value for a message, shortened where it is long."""
    return beginning(value, 60, repr)


def _plain(name: str, value: Any, whole: bool) -> float | int:
    if not is_number(value):
        raise FirsthitError(f"{name} is a {'whole ' if whole else ''}number, not {shown(value)}")
    if not isinstance(value, Integral) and whole:
        raise FirsthitError(f"{name} is a whole number, not {value}")
    return int(value) if isinstance(value, Integral) else float(value)


AZIMUTH = Within(-360.0, 360.0)  # degrees
ELEVATION = Within(-90.0, 90.0)  # degrees
FIELD_OF_VIEW = Within(1e-3, 179.0)  # degrees
DISTANCE = Within(1e-6, 1e9)  # scene units
POSITION = Within(-1e9, 1e9)  # scene units
JOBS = Within(1, 1024)  # processes
SEED = Within(0, 2**63 - 1)
SHARE = Within(0.0, 1.0)
PIXELS = Within(1, 16384)  # per side of a frame that is timed, and rays per side of a view
PICTURE = Within(1, 8192, "an image has {low} to {high} pixels per side, not {value}")
RAYS = Within(1, 4096)  # per side of a view whose answers are checked
SECONDS = Within(0.0, 1e5)  # of timing
TIMEOUT = Within(1e-3, 1e6)  # seconds
