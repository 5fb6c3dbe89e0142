"""A run folder → the plan and one flat row for each finished cell. Nothing here draws or computes."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from harness.contract import CellStatus, FirsthitError
from reports import store
from reports.schema import flatten

FORMAT = 1


@dataclass(frozen=True)
class Plan:
    """plan.json: what the run set out to do, where, and by which command."""

    name: str
    title: str
    config: str
    config_text: str
    command: str
    created: str  # ISO 8601
    environment: Mapping[str, Any]
    devices: tuple[Mapping[str, Any], ...]
    slots: Mapping[str, str]  # cell key → slot, in the plan's order


@dataclass(frozen=True)
class Unreadable:
    """A file of the run that could not be used, and why."""

    file: str  # below the run folder
    problem: str


@dataclass(frozen=True, eq=False)
class Run:
    """`frame` has one row for each finished cell of the plan, in the plan's order, and the columns of SCHEMA."""

    folder: Path
    plan: Plan
    frame: pd.DataFrame
    unreadable: tuple[Unreadable, ...]
    not_run: tuple[str, ...]  # slots


def load(folder: Path) -> Run:
    """The run in `folder`; a FirsthitError where that is no run folder or holds no finished cell."""
    plan = _plan(folder)
    rows: list[tuple[Any, ...]] = []
    unreadable: list[Unreadable] = []
    not_run: list[str] = []
    for key, slot in plan.slots.items():
        path = folder / "cells" / f"{key}.json"
        try:
            rows.append(flatten(_cell(path, key)))
        except FileNotFoundError:
            not_run.append(slot)
        except (OSError, ValueError, RecursionError) as error:
            unreadable.append(Unreadable(f"cells/{path.name}", f"{problem(error)} ({slot})"))
    if not rows:
        damaged = f" ({len(unreadable)} are unreadable: {unreadable[0].problem})" if unreadable else ""
        raise FirsthitError(f"{folder} holds no finished cell{damaged}; run `{plan.command}` first")
    return Run(folder, plan, store.frame(rows), tuple(unreadable), tuple(not_run))


def _cell(path: Path, key: str) -> dict[str, Any]:
    document = _json_object(path)
    if document.get("format") != FORMAT:
        raise ValueError(f"its format is {document.get('format')!r:.40}, not {FORMAT}")
    if document.get("key") != key:
        raise ValueError(f"it names another cell's key, {document.get('key')!r:.40}")
    if document.get("status") not in list(CellStatus):
        raise ValueError(f"its status is {document.get('status')!r:.40}, not one of {', '.join(CellStatus)}")
    return document


def _plan(folder: Path) -> Plan:
    path = folder / "plan.json"
    if not folder.is_dir():
        raise FirsthitError(f"there is no run folder {folder}; `firsthit run CONFIG` makes one under runs/")
    try:
        document = _json_object(path)
        if document.get("format") != FORMAT:
            raise ValueError(f"its format is {document.get('format')!r:.40}, not {FORMAT}")
        texts = {name: _typed(document, name, str) for name in _TEXTS}
        cells = [(_typed(cell, "key", str), _typed(cell, "slot", str)) for cell in _typed(document, "cells", list)]
        for key, _ in cells:
            if not key.isalnum():  # it becomes a file's name
                raise ValueError(f"{key!r:.40} is no cell key")
        devices = tuple(_typed({"device": device}, "device", dict) for device in _typed(document, "devices", list))
        return Plan(**texts, environment=_typed(document, "environment", dict), devices=devices, slots=dict(cells))
    except FileNotFoundError as error:
        raise FirsthitError(f"{folder} is no run folder: it has no plan.json; name a folder under runs/") from error
    except (OSError, ValueError, RecursionError) as error:
        raise FirsthitError(f"cannot read {path}: {problem(error)}; run the config again to rewrite it") from error


_TEXTS = ("name", "title", "config", "config_text", "command", "created")


def problem(error: Exception) -> str:
    """What went wrong, without the path that an OSError adds."""
    return (isinstance(error, OSError) and error.strerror) or str(error)


def _json_object(path: Path) -> dict[str, Any]:
    try:
        document = json.loads(path.read_bytes())
    except ValueError as error:
        raise ValueError(f"truncated or no JSON: {error}") from error
    if not isinstance(document, dict):
        raise ValueError("it holds no JSON object")
    return document


def _typed(document: Any, name: str, kind: type) -> Any:
    value = document.get(name) if isinstance(document, dict) else None
    if not isinstance(value, kind):
        raise ValueError(f"{name} is missing or no {kind.__name__}")
    return value
