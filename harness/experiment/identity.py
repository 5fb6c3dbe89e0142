"""State what decides a cell's row: two cells with the same identity have the same row, except for the clock's noise."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from harness.devices.host import cores, processor, settings
from harness.plugins import Catalog
from harness.results import sources

HASHED = ("program", "program order", "methodology", "method")


def common(folders: Iterable[Path], timed: bool) -> dict[str, Any]:
    """Return what every cell's identity holds beside its question and program; `folders` are its methods'.

    The number of cores decides times only. So the identity of a cell that is not timed is the same on more of them.
    """
    own: dict[str, str] = {}
    for folder in folders:
        own |= _of_method(folder)
    return {
        "methodology": sources.methodology(),
        "method": own,
        "packages": sources.packages(),
        "settings": settings(),
        "processor": processor(),
        "cores": cores() if timed else None,
    }


@cache
def _of_method(folder: Path) -> dict[str, str]:
    return sources.of_method(folder)


def since(stored: Mapping[str, Any], catalog: Catalog) -> list[str]:
    """List what differs between `common` and a stored identity, a line each; the config is not looked at."""
    if "method" not in stored:
        return ["the harness, which named less of what decides a row then"]
    names = [Path(file).parent.name for file in stored["method"] if file.endswith("/method.py")]
    folders = [catalog.plugins[name].folder for name in names if name in catalog.plugins]
    now = common(folders, timed=stored["cores"] is not None)
    return changes({name: stored[name] for name in now}, now)


def changes(old: Mapping[str, Any], new: Mapping[str, Any], path: str = "") -> list[str]:
    """List what differs between two identities, a line each.

    Of a hash only the name is told.
    """
    lines: list[str] = []
    for key in sorted(old.keys() | new.keys()):
        name = f"{path}{key}"
        a, b = old.get(key), new.get(key)
        if isinstance(a, dict) and isinstance(b, dict):
            lines += changes(a, b, f"{name}: ")
        elif a != b:
            is_hash = name.partition(":")[0] in HASHED
            word = "is new" if key not in old else "is gone" if key not in new else "changed"
            lines.append(f"{name} {word}" if is_hash else f"{name}: {a!r} → {b!r}")
    return lines
