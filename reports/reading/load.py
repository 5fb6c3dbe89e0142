"""Read a run folder: its plan, and one flat row for each finished cell and rung. Nothing here draws or computes."""

from __future__ import annotations

import contextlib
import gc
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from harness.contract import BASELINE, CellStatus, FirsthitError, suggestion
from harness.escaping import whole
from harness.results.schema import FAMILY, RUNG, SCHEMA, flatten
from reports import labels
from reports.reading import collect, export
from reports.reading.run import Facts, Plan, Run, Unreadable

FORMAT = 1


def load(folder: Path) -> Run:
    """Read the run in `folder`, or those that it collects.

    Raises FirsthitError where it is no run folder, or where nothing is finished.
    """
    plan = plan_of(folder)
    if not plan.include:
        return load_one(folder, plan)
    runs: list[Run] = []
    missing: list[Unreadable] = []
    for name in plan.include:
        try:
            runs.append(load(folder.parent / name))
        except FirsthitError as error:
            missing.append(Unreadable(name, str(error)))
    return collect.together(folder, plan, runs, missing)


def over(frame: pd.DataFrame, baseline: str | None) -> pd.DataFrame:
    """Return `frame` with another baseline, or as it is where that is None.

    Raises FirsthitError where no row that answers has that baseline.
    """
    return frame if baseline is None else frame.assign(baseline=_answering(frame, baseline, "--baseline"))


def focus_of(run: Run, focus: str | None) -> str:
    """Return the method or variant that the report of `run` is about: `focus`, else the config's; "" for none.

    Raises FirsthitError where no row that answers has it.
    """
    named = run.plan.focus if focus is None else focus
    told = ["answers", "method", "variant"]
    return (
        _answering(pd.concat([run.frame[told], run.families[told]]), named, "--focus" if focus else "focus")
        if named
        else ""
    )


def _answering(frame: pd.DataFrame, name: str, option: str) -> str:
    """Return `name` where it is a method or variant of a row that answers. Raises FirsthitError where it is none."""
    answering = frame[frame["answers"].astype(bool)]
    known = list(dict.fromkeys([*answering["method"], *answering["variant"]]))
    if name not in known:
        raise FirsthitError(f"{option}: unknown {name!r}; {suggestion(name, known)}")
    return name


@contextlib.contextmanager
def _uncollected() -> Iterator[None]:
    """Switch Python's search for cyclic garbage off within the block.

    JSON has no cycles, and the search takes a fifth of the time of 100,000 rows.
    """
    was = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was:
            gc.enable()


@_uncollected()
def load_one(folder: Path, plan: Plan) -> Run:
    """Read what the cells that `plan` names say. Raises FirsthitError where none of them is finished."""
    rows: list[tuple[Any, ...]] = []
    families: list[tuple[Any, ...]] = []
    rungs: list[tuple[Any, ...]] = []
    unreadable: list[Unreadable] = []
    not_run: list[str] = []
    for key, slot in plan.slots.items():
        path = folder / "cells" / f"{key}.json"
        try:
            document = _cell(path, key) | {"run": plan.name, "baseline": plan.baseline}
            if document.get("family") is None:
                rows.append(flatten(SCHEMA, document))
            else:
                ladder = _ladder(document, plan.facts)
                families.append(flatten(FAMILY, document))
                rungs += ladder
        except FileNotFoundError:
            not_run.append(slot)
        except (OSError, ValueError, RecursionError) as error:
            unreadable.append(Unreadable(f"cells/{path.name}", f"{problem(error)} ({slot})"))
    studies: dict[str, list[dict[str, Any]]] = {}
    for name, key in plan.studies.items():
        path = folder / "studies" / f"{key}.json"
        try:
            studies[name] = _study(path)
        except FileNotFoundError:
            not_run.append(f"study {name}")
        except (OSError, ValueError, RecursionError) as error:
            unreadable.append(Unreadable(f"studies/{path.name}", f"{problem(error)} ({name})"))
    if not rows and not families and not studies:
        damaged = f" ({len(unreadable)} are unreadable: {unreadable[0].problem})" if unreadable else ""
        raise FirsthitError(f"{folder} holds no finished cell{damaged}; run `{plan.command}` first")
    made = (export.frame(schema, found) for schema, found in ((SCHEMA, rows), (FAMILY, families)))
    views, ladders = (labels.labelled(frame, plan.methods) for frame in made)
    broken, missing = tuple(unreadable), tuple(not_run)
    return Run(folder, plan, views, ladders, export.frame(RUNG, rungs), broken, missing, studies, {plan.name: folder})


def _ladder(document: dict[str, Any], facts: Mapping[str, Facts]) -> list[tuple[Any, ...]]:
    """Return the rungs of a family's cell, which stores them going harder; none where it gave no result.

    Raises ValueError where a rung is not as harness.results.schema.RUNG says, or the plan does not know the family.
    """
    if document["family"] not in facts:
        raise ValueError(f"the plan says nothing of its family, {document['family']!r:.40}")
    rungs = [] if document.get("rungs") is None else _typed(document, "rungs", list)
    for rung in rungs:
        if not isinstance(rung, dict):
            raise ValueError(f"a rung is no object: {rung!r:.40}")
    return [flatten(RUNG, {**rung, "key": document["key"], "level": level}) for level, rung in enumerate(rungs)]


def _cell(path: Path, key: str) -> dict[str, Any]:
    """Read a cell's file. Raises ValueError where it is damaged, of another version or of another cell."""
    document = _json_object(path)
    if document.get("format") != FORMAT:
        raise ValueError(f"its format is {document.get('format')!r:.40}, not {FORMAT}")
    if document.get("key") != key:
        raise ValueError(f"it names another cell's key, {document.get('key')!r:.40}")
    if document.get("status") not in list(CellStatus):
        raise ValueError(f"its status is {document.get('status')!r:.40}, not one of {', '.join(CellStatus)}")
    return document


def _study(path: Path) -> list[dict[str, Any]]:
    """Read the rows of a study. Raises ValueError where its file is damaged."""
    rows: list[dict[str, Any]] = _typed(_json_object(path), "rows", list)
    if not all(isinstance(row, dict) for row in rows):
        raise ValueError("a row is no object")
    return rows


def plan_of(folder: Path) -> Plan:
    """Read a run's plan. Raises FirsthitError where there is none, or where it is damaged."""
    path = folder / "plan.json"
    if not folder.is_dir():
        raise FirsthitError(f"there is no run folder {folder}; `firsthit run CONFIG` makes one under runs/")
    try:
        document = _json_object(path)
        if document.get("format") != FORMAT:
            raise ValueError(f"its format is {document.get('format')!r:.40}, not {FORMAT}")
        texts = {name: _typed(document, name, str) for name in _TEXTS}
        planned = [*_typed(document, "cells", list), *_typed({"families": [], **document}, "families", list)]
        cells = [(_typed(cell, "key", str), _typed(cell, "slot", str)) for cell in planned]
        stated = _typed({"family_facts": {}, **document}, "family_facts", dict)
        facts = {family: Facts(**{name: _typed(stated[family], name, str) for name in _FACTS}) for family in stated}
        for key, _ in cells:
            if not key.isalnum():  # it becomes a file's name
                raise ValueError(f"{key!r:.40} is no cell key")
        devices = tuple(_typed({"device": device}, "device", dict) for device in _typed(document, "devices", list))
        environment = _typed(document, "environment", dict)
        stored = _typed({"studies": [], **document}, "studies", list)
        studies = {_typed(study, "study", str): _typed(study, "key", str) for study in stored}
        include = tuple(_typed({"include": [], **document}, "include", list))
        for name in (*studies.values(), *include):
            if not isinstance(name, str) or Path(name).name != name:  # it becomes a file's or a folder's name
                raise ValueError(f"{name!r:.40} is no name")
        baseline = _typed({"baseline": BASELINE, **document}, "baseline", str)
        focus = _typed({"focus": "", **document}, "focus", str)
        stated = _typed({"methods": {}, **document}, "methods", dict)
        methods = {name: _typed(stated, name, dict) for name in stated}
        told = {
            "environment": environment,
            "methods": methods,
            "devices": devices,
            "slots": dict(cells),
            "facts": facts,
        }
        return Plan(**texts, **told, studies=studies, include=include, baseline=baseline, focus=focus)
    except FileNotFoundError as error:
        raise FirsthitError(f"{folder} is no run folder: it has no plan.json; name a folder under runs/") from error
    except (OSError, ValueError, RecursionError) as error:
        raise FirsthitError(f"cannot read {path}: {problem(error)}; run the config again to rewrite it") from error


_TEXTS = ("name", "title", "config", "config_text", "command", "created")
_FACTS = ("title", "parameter", "harder", "why", "source")


def problem(error: Exception) -> str:
    """Say what went wrong, without the path that an OSError adds."""
    return (isinstance(error, OSError) and error.strerror) or str(error)


def _json_object(path: Path) -> dict[str, Any]:
    """Read a file that holds one JSON object. Raises ValueError where it does not."""
    content = path.read_bytes()
    try:
        document = json.loads(content)
    except ValueError as error:
        raise ValueError(f"truncated or no JSON: {error}") from error
    if b"\\ud" in content.lower():  # perhaps a half of a character
        document = whole(document)
    if not isinstance(document, dict):
        raise ValueError("it holds no JSON object")
    return document


def _typed(document: Any, name: str, kind: type) -> Any:
    """Return the value of `name` in an object. Raises ValueError where it is missing or not of `kind`."""
    value = document.get(name) if isinstance(document, dict) else None
    if not isinstance(value, kind):
        raise ValueError(f"{name} is missing or no {kind.__name__}")
    return value
