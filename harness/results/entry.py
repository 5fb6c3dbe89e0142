"""Declare what is kept of a row to hold others against: an entry of a baseline or of the history, and its device."""

# Without `from __future__ import annotations`: on texts TypedDict does not see which members are NotRequired.

from typing import Annotated, Any, NotRequired, TypedDict

from harness.contract import CellStatus
from harness.limits import OneOf
from harness.results import declared
from harness.results.declared import NOT_NEGATIVE
from harness.results.figures import GATED


class Entry(TypedDict):
    """Hold what harness/gate/entries.py says of a row; its gated figures stand beside these."""

    scene: str
    status: Annotated[str, OneOf(tuple(CellStatus))]
    program: NotRequired[str]
    reason: NotRequired[str]
    lacks: NotRequired[bool]
    device_level: NotRequired[int]
    last_bit: NotRequired[Annotated[float, NOT_NEGATIVE]]
    mesher: NotRequired[str]


class Facts(TypedDict):
    """Hold a device: names and versions for people, its fingerprint, and of a baseline who blessed it and why."""

    name: str
    title: NotRequired[str | None]
    driver: NotRequired[str | None]
    compiler: NotRequired[str | None]
    processor: NotRequired[str | None]
    versions: NotRequired[dict[str, str]]
    arithmetic: NotRequired[dict[str, dict[str, str]]]
    blessed: NotRequired[str]
    commit: NotRequired[str]
    reason: NotRequired[str]


_ENTRY = declared.checker(Entry)
_FIGURE = declared.checker(Annotated[float, NOT_NEGATIVE])
device = declared.checker(Facts)


def check(row: Any, path: str) -> None:
    """Hold an entry against its declaration. Raises ValueError, which names the member."""
    _ENTRY(row, path)
    for name in row.keys() & GATED.keys():
        _FIGURE(row[name], f"{path}: its {name}")
