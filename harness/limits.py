"""State on a field itself what it may hold: `size: Annotated[int, Within(1, 4096)] = 128`.

A limit's `broken` says what is wrong with a value, or None where nothing is. harness.experiment.reading holds every
field of a config against its limits, and adds the field's name, the file and the line.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from surfaces.words import suggestion


class Limit(Protocol):
    """Define a limit of a field: what stands beside the type in `Annotated`."""

    def broken(self, value: Any) -> str | None:
        """Say why a field cannot hold `value`; None where it can."""


@dataclass(frozen=True)
class Within:
    """State that a number lies between `low` and `high`, both included.

    `words` is the text of the mistake; it may name {value}, {low} and {high}.
    """

    low: float
    high: float
    words: str = "{value} is outside [{low:g}, {high:g}]"

    def broken(self, value: float) -> str | None:
        if self.low <= value <= self.high:
            return None
        return self.words.format(value=value, low=self.low, high=self.high)


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


@dataclass(frozen=True)
class Named:
    """A name that is known, or none: an empty text. `names` is called when a config is read."""

    names: Callable[[], Iterable[str]]

    def broken(self, value: str) -> str | None:
        return Known(self.names).broken([value]) if value else None


@dataclass(frozen=True)
class Distinct:
    """State that a list holds nothing twice. `names` gives what must differ, where it is not the items themselves."""

    names: Callable[[Any], Sequence[Any]] = list

    def broken(self, value: Any) -> str | None:
        names = self.names(value)
        twice = next((name for name in names if names.count(name) > 1), None)
        return None if twice is None else f"{twice!r} is named twice"


def is_finite(value: float) -> bool:
    """Tell whether a number is finite; a whole number that is too large for a float is not."""
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number of more than 308 digits
        return False


AZIMUTH = Within(-360.0, 360.0)  # degrees
ELEVATION = Within(-90.0, 90.0)  # degrees
FIELD_OF_VIEW = Within(1e-3, 179.0)  # degrees
DISTANCE = Within(1e-6, 1e9)  # scene units
POSITION = Within(-1e9, 1e9)  # scene units
SEED = Within(0, 2**63 - 1)
SHARE = Within(0.0, 1.0)
