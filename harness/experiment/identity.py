"""State what decides a cell's row: two cells with the same identity have the same row, except for the clock's noise."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal

from harness.devices.host import Host, this_host
from harness.plugins import Catalog
from harness.results import sources

HASHED = ("program", "program order", "methodology", "method")


def common(folders: Iterable[Path], timed: bool, host: Host | None = None) -> dict[str, Any]:
    """Return what every cell's identity holds beside its question and program; `folders` are its methods'.

    `host` is the machine of the cell's device; None: this one. The number of cores decides times only. So the identity
    of a cell that is not timed is the same on more of them.
    """
    own: dict[str, str] = {}
    for folder in folders:
        own |= _of_method(folder)
    there = host or this_host()
    return {
        "methodology": sources.methodology(),
        "method": own,
        "packages": sources.packages(),
        "settings": dict(there.settings),
        "processor": there.processor,
        "cores": there.cores if timed else None,
    }


@cache
def _of_method(folder: Path) -> dict[str, str]:
    return sources.of_method(folder)


@dataclass(frozen=True)
class Difference:
    """Hold what differs between two identities.

    part: the names that lead to it: ("device", "driver")
    before, now: its values; None where it is not there, and where it is known by a hash only
    """

    part: tuple[str, ...]
    change: Literal["changed", "new", "gone"]
    before: Any = None
    now: Any = None

    def __str__(self) -> str:
        """Say it in a line. Of a hash only the name is told."""
        name, word = ": ".join(self.part), {"changed": "changed", "new": "is new", "gone": "is gone"}[self.change]
        hidden = self.before is None and self.now is None
        return f"{name} {word}" if hidden else f"{name}: {self.before!r} → {self.now!r}"


OLDER = Difference(("harness", "what it names as deciding a row"), "changed")


def since(stored: Mapping[str, Any], catalog: Catalog) -> list[Difference]:
    """List what differs between `common` and a stored identity; the config is not looked at."""
    if "method" not in stored:
        return [OLDER]
    names = [Path(file).parent.name for file in stored["method"] if file.endswith("/method.py")]
    folders = [catalog.plugins[name].folder for name in names if name in catalog.plugins]
    now = common(folders, timed=stored["cores"] is not None)
    return changes({name: stored[name] for name in now}, now)


def changes(old: Mapping[str, Any], new: Mapping[str, Any], path: tuple[str, ...] = ()) -> list[Difference]:
    """List what differs between two identities, sorted by names."""
    found: list[Difference] = []
    for key in sorted(old.keys() | new.keys()):
        part = (*path, key)
        a, b = old.get(key), new.get(key)
        if isinstance(a, dict) and isinstance(b, dict):
            found += changes(a, b, part)
        elif a != b:
            change: Literal["changed", "new", "gone"]
            change = "new" if key not in old else "gone" if key not in new else "changed"
            found.append(Difference(part, change, *(() if part[0] in HASHED else (a, b))))
    return found
