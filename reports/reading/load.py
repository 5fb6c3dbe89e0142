"""Read a run folder: its plan, and one flat row for each finished cell and rung. Nothing here draws or computes."""

from __future__ import annotations

import contextlib
import gc
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd

from harness.contract import BASELINE, FirsthitError, suggestion
from harness.results import archive, plan_file, study_file
from harness.results.schema import FAMILY, RUNG, SCHEMA, flattener
from harness.results.sealed import problem
from harness.results.store import read_row
from reports import labels
from reports.reading import collect, export
from reports.reading.run import Facts, Plan, Run, Unreadable


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


@contextlib.contextmanager
def opened(run: Path) -> Iterator[Run]:
    """Read a run from its folder or from an archive of it, whose files are there while the block runs.

    Raises FirsthitError as `load` does, and where an archive cannot be unpacked.
    """
    with archive.opened(run) as folder:
        yield replace(load(folder), folder=run)


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
            document = read_row(path, key) | {"run": plan.name, "baseline": plan.baseline}
            if document.get("family") is None:
                rows.append(_VIEW(document))
            else:
                ladder = _ladder(document, plan.facts)
                families.append(_FAMILY(document))
                rungs += ladder
        except FileNotFoundError:
            not_run.append(slot)
        except (OSError, ValueError) as error:
            unreadable.append(Unreadable(f"cells/{path.name}", f"{problem(error)} ({slot})"))
    studies: dict[str, list[dict[str, Any]]] = {}
    for name, key in plan.studies.items():
        path = folder / "studies" / f"{key}.json"
        try:
            studies[name] = study_file.read(path, name, key)["rows"]
        except FileNotFoundError:
            not_run.append(f"study {name}")
        except (OSError, ValueError) as error:
            unreadable.append(Unreadable(f"studies/{path.name}", f"{problem(error)} ({name})"))
    if not rows and not families and not studies:
        if plan.shard and not plan.slots:
            raise FirsthitError(f"{folder} is{plan.part.replace(',', '')} of {plan.config}, which has no cell in it")
        damaged = f" ({len(unreadable)} are unreadable: {unreadable[0].problem})" if unreadable else ""
        raise FirsthitError(f"{folder} holds no finished cell{damaged}; run `{plan.command}` first")
    made = (export.frame(schema, found) for schema, found in ((SCHEMA, rows), (FAMILY, families)))
    views, ladders = (labels.labelled(_as_told(frame, plan), plan.methods) for frame in made)
    broken, missing = tuple(unreadable), tuple(not_run)
    return Run(folder, plan, views, ladders, export.frame(RUNG, rungs), broken, missing, studies, {plan.name: folder})


def _as_told(frame: pd.DataFrame, plan: Plan) -> pd.DataFrame:
    """Return rows with their devices as the plan of a merged run tells them, in the slots too."""
    if not plan.told:
        return frame
    told = [plan.told.get(key, device) for key, device in zip(frame["key"], frame["device"], strict=True)]
    of = zip(frame["slot"], frame["device"], told, strict=True)
    slots = [slot.removesuffix(device) + new for slot, device, new in of]
    return frame.assign(
        device=pd.Series(told, frame.index, dtype=object), slot=pd.Series(slots, frame.index, dtype=object)
    )


def _ladder(document: dict[str, Any], facts: Mapping[str, Facts]) -> list[tuple[Any, ...]]:
    """Return the rungs of a family's cell, which stores them going harder; none where it gave no result.

    Raises ValueError where the plan does not know the family.
    """
    if document["family"] not in facts:
        raise ValueError(f"the plan says nothing of its family, {document['family']!r:.40}")
    rungs = document.get("rungs") or []
    return [_RUNG({**rung, "key": document["key"], "level": level}) for level, rung in enumerate(rungs)]


def plan_of(folder: Path) -> Plan:
    """Read a run's plan. Raises FirsthitError where there is none, or where it is damaged."""
    path = folder / "plan.json"
    if not folder.is_dir():
        raise FirsthitError(f"there is no run folder {folder}; `firsthit run CONFIG` makes one under runs/")
    try:
        told = plan_file.read(path)
    except FileNotFoundError as error:
        raise FirsthitError(f"{folder} is no run folder: it has no plan.json; name a folder under runs/") from error
    except (OSError, ValueError) as error:
        raise FirsthitError(f"cannot read {path}: {problem(error)}; run the config again to rewrite it") from error
    families: dict[str, dict[str, Any]] = told.get("family_facts", {})
    listed = (*told["cells"], *told.get("families", ()))
    return Plan(
        **{name: told[name] for name in _TEXTS},
        environment=told["environment"],
        devices=tuple(told["devices"]),
        slots={cell["key"]: cell["slot"] for cell in listed},
        told={cell["key"]: cell["device"] for cell in listed if "device" in cell},
        shard=(told["shard"]["number"], told["shard"]["of"]) if "shard" in told else None,
        merged=tuple(told.get("merged", ())),
        facts={name: Facts(**{part: one[part] for part in _FACTS}) for name, one in families.items()},
        studies={study["study"]: study["key"] for study in told.get("studies", ())},
        methods=told.get("methods", {}),
        include=tuple(told.get("include", ())),
        baseline=told.get("baseline", BASELINE),
        focus=told.get("focus", ""),
    )


_TEXTS = ("name", "title", "config", "config_text", "command", "created")
_FACTS = ("title", "parameter", "harder", "why", "source")
_VIEW, _FAMILY, _RUNG = map(flattener, (SCHEMA, FAMILY, RUNG))
