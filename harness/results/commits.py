"""Keep the gated figures of a run by commit: one small file for each commit and device, below history/NAME/.

    2026-11-28-0123456789ab-opencl-pocl-1f3a6c.json         of a clean tree; keeping the commit again replaces it
    2026-11-28-0123456789ab-dirty-opencl-pocl-1f3a6c.json   of the same commit with uncommitted changes

A file is written whole or not at all and never changed by another commit, so that git merges folders of them, and a CI
server may commit them or hold them in a cache. It holds no time of writing: the same figures give the same bytes. Each
row has a line of its own.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any, TypedDict

from harness.contract import FirsthitError, digest
from harness.results import declared, entry, sealed
from harness.results.writing import write_atomically

FORMAT = 1
ALIKE = ("title", "driver", "compiler", "processor")  # facts that stand for a device's arithmetic where it is not known
SIZED = ("evaluations_mean",)  # not comparable where a quadtree begins at another level (Entry.device_level)
_HASH = re.compile("[0-9a-f]{7,64}")


@dataclass(frozen=True)
class Commit:
    """Name a commit of a git repository.

    hash: all its digits
    date: when it was committed, ISO 8601 in UTC
    subject: the first line of its message
    dirty: the tree had uncommitted changes, so that the commit alone does not give these figures
    """

    hash: str
    date: str
    subject: str
    dirty: bool

    @property
    def short(self) -> str:
        """Return the first 12 digits of the hash."""
        return self.hash[:12]


@dataclass(frozen=True, eq=False)
class Kept:
    """Hold what one device gave at one commit.

    device: its facts, as a baseline holds them; `arithmetic`, its fingerprint, where it is known
    rows: by slot the status, `scene` (a hash of what was asked), `program` (its hash), the gated figures and, of a row
        that did not end well, the `reason`
    harness: version and commit of firsthit, which may be another repository's than `commit`
    """

    config: str
    commit: Commit
    device: Mapping[str, Any]
    rows: Mapping[str, Mapping[str, Any]]
    harness: Mapping[str, Any] = field(default_factory=dict)


def write(folder: Path, kept: Kept, device_key: str) -> Path:
    """Write one file into `folder` and return its path. `device_key` tells this device from others, also in the name.

    Raises FirsthitError where it cannot be written.
    """
    dirty = "-dirty" if kept.commit.dirty else ""
    device = re.sub(r"[^A-Za-z0-9.]+", "-", device_key).strip("-")
    path = folder / f"{kept.commit.date[:10]}-{kept.commit.short}{dirty}-{device}.json"
    write_atomically(path, sealed.with_seal(_text(kept)))
    return path


def _text(kept: Kept) -> str:
    """Write a kept run as JSON, each row on a line of its own."""

    def line(value: Any) -> str:
        return json.dumps(value, ensure_ascii=False, sort_keys=True, allow_nan=False)

    head = {"format": FORMAT, "config": kept.config, "commit": asdict(kept.commit)}
    head |= {"firsthit": dict(kept.harness), "device": dict(kept.device)}
    lines = [f"{line(name)}: {line(value)}," for name, value in head.items()]
    rows = [f"{line(slot)}: {line(dict(kept.rows[slot]))}" for slot in sorted(kept.rows)]
    return "\n".join(["{", *lines, '"rows": {', ",\n".join(rows), "}", "}"]) + "\n"


def read_all(folder: Path) -> tuple[list[Kept], list[str]]:
    """Read every file of a folder, in the order of their names. Returns the runs, and why files could not be read."""
    found: list[Kept] = []
    problems: list[str] = []
    for path in sorted(folder.glob("*.json")):
        if path.name.startswith("."):  # what a stopped process left
            continue
        try:
            found.append(_read(path))
        except FirsthitError as error:
            problems.append(str(error))
    return found, problems


def _read(path: Path) -> Kept:
    """Read one file. Raises FirsthitError, which names it, where it is damaged or of another format."""
    try:
        stored = sealed.read(path)
        if stored.get("format") != FORMAT:
            told = stored.get("format")
            raise FirsthitError(f"{path} is not of this version's format ({told!r:.40}, not {FORMAT}); it is left out")
        _CHECK(stored, "")
        entry.device(stored["device"], "device")
        for slot, row in stored["rows"].items():
            entry.check(row, slot)
        commit = Commit(**{name: stored["commit"][name] for name in _StoredCommit.__annotations__})
        if not _HASH.fullmatch(commit.hash) or datetime.fromisoformat(commit.date).utcoffset() != timedelta(0):
            raise ValueError(f"{commit.hash!r} of {commit.date!r} names no commit; dates are in UTC")
        return Kept(stored["config"], commit, stored["device"], stored["rows"], stored["firsthit"])
    except (OSError, ValueError) as error:
        told = sealed.problem(error)
        raise FirsthitError(f"{path} is damaged and left out ({told:.200}); restore it, or remove it") from None


class _StoredCommit(TypedDict):
    """Declare what a file says of its commit."""

    hash: str
    date: str
    subject: str
    dirty: bool


class _Stored(TypedDict):
    """Declare what a file holds."""

    config: str
    commit: _StoredCommit
    firsthit: dict[str, Any]
    device: dict[str, Any]
    rows: dict[str, dict[str, Any]]


_CHECK = declared.checker(_Stored)


def same_arithmetic(device: Mapping[str, Any], slot: str) -> str:
    """Return a text that two devices share where a row of this slot has the same arithmetic on both.

    It follows from what a device's fingerprint holds for the row's precision, for the host and, of stage raster, for
    the rasteriser. Where one of these is not kept, the facts ALIKE stand for it.
    """
    arithmetic, words = device.get("arithmetic") or {}, slot.split()
    parts = ["float64" if "float64" in words else "float32", "host", *(["raster"] if "raster" in words else [])]
    told = [arithmetic.get(part) for part in parts]
    return digest(told if all(told) else [*told, *(device.get(name) for name in ALIKE)])
