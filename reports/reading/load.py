"""Read a run folder: its plan, and one flat row for each finished cell and rung. Nothing here draws or computes."""

from __future__ import annotations

import contextlib
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa

from harness.contract import BASELINE, FirsthitError, suggestion
from harness.results import archive, plan_file, study_file
from harness.results.compaction import FAMILY as FAMILY_COLUMN
from harness.results.garbage import uncollected
from harness.results.parts import Part, damage
from harness.results.schema import FAMILY, RUNG, flattener
from harness.results.sealed import problem
from harness.results.store import Row, Store, row_of
from reports import labels
from reports.reading import collect, columns, export
from reports.reading.columns import Columns
from reports.reading.run import Facts, Plan, Run, Unreadable


def load(folder: Path, unread: Collection[str] = ()) -> Run:
    """Read the run in `folder`, or those that it collects; the frame of rows has not the columns `unread`.

    Raises FirsthitError where it is no run folder, or where nothing is finished.
    """
    plan = plan_of(folder)
    if not plan.include:
        return load_one(folder, plan, unread)
    runs: list[Run] = []
    missing: list[Unreadable] = []
    for name in plan.include:
        try:
            runs.append(load(folder.parent / name, unread))
        except FirsthitError as error:
            missing.append(Unreadable(name, str(error)))
    return collect.together(folder, plan, runs, missing)


@contextlib.contextmanager
def opened(run: Path, unread: Collection[str] = ()) -> Iterator[Run]:
    """Read a run as `load` does, from its folder or from an archive of it, whose files are there while the block runs.

    Raises FirsthitError as `load` does, and where an archive cannot be unpacked.
    """
    with archive.opened(run) as folder:
        yield replace(load(folder, unread), folder=run)


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


@dataclass
class _Found:
    """Gather what the cells that a plan names say, in the plan's order."""

    views: list[Row] = field(default_factory=list)  # that are not in a table yet
    tables: list[pa.Table] = field(default_factory=list)
    families: list[tuple[Any, ...]] = field(default_factory=list)
    rungs: list[tuple[Any, ...]] = field(default_factory=list)
    unreadable: list[Unreadable] = field(default_factory=list)
    not_run: list[str] = field(default_factory=list)
    keys: list[str] = field(default_factory=list)  # of the views
    places: list[tuple[int, int]] = field(default_factory=list)  # of each view: -1, or its part; and its place there

    def view(self, row: Row) -> None:
        """Add the row of a view."""
        self.places.append((-1, len(self.views) + HELD * len(self.tables)))
        self.views.append(row)
        if len(self.views) == HELD:
            self.tables.append(columns.held(self.views))
            self.views = []

    def columns(self, parts: Sequence[Part]) -> Columns:
        """Return where the views lie."""
        own = pa.concat_tables([*self.tables, columns.held(self.views)])
        places = np.array(self.places, np.int64).reshape(-1, 2)
        nothing = own.slice(0, 0)
        pieces = (nothing if part.problem else part for part in parts)  # no row is read of a damaged one
        return Columns((own, *pieces), (places[:, 0] + 1).astype(np.int32), places[:, 1])


@uncollected()
def load_one(folder: Path, plan: Plan, unread: Collection[str] = ()) -> Run:
    """Read what the cells that `plan` names say, without the columns `unread`.

    Raises FirsthitError where none of them is finished.
    """
    store = Store(folder)
    while True:
        try:
            return _load_one(store, plan, unread)
        except columns.Refused as refused:  # then its rows are read one by one, as those of any damaged part
            refused.part.problem = str(refused)


def _load_one(store: Store, plan: Plan, unread: Collection[str]) -> Run:
    """Do what `load_one` does. Raises columns.Refused where the columns of a part cannot be used."""
    folder, found = store.folder, _Found()
    own = set(store.files())
    parts = store.parts.all()
    which, places = store.parts.locate(np.array([key.encode() for key in plan.slots], dtype=np.bytes_))
    ladders = [_families(part) for part in parts]
    found.unreadable += [Unreadable(name, problem) for name, problem in store.parts.problems().items()]
    for (key, slot), part, place in zip(plan.slots.items(), which.tolist(), places.tolist(), strict=True):
        if part >= 0 and key not in own and not parts[part].problem and place not in ladders[part]:
            found.places.append((part, place))
            found.keys.append(key)
            continue
        try:
            row = row_of(store.text(key), key)
            if row.get("family") is None:
                found.view(row)
                found.keys.append(key)
            else:
                ladder = _ladder(row, plan.facts)
                found.families.append(_FAMILY(row | {"run": plan.name}))
                found.rungs += ladder
        except FileNotFoundError:
            found.not_run.append(slot)
        except (OSError, ValueError) as error:
            name = store.place(key).relative_to(folder).as_posix()
            found.unreadable.append(Unreadable(name, f"{problem(error)} ({slot})"))
    studies = _studies(folder, plan, found)
    if not found.places and not found.families and not studies:
        if plan.shard and not plan.slots:
            raise FirsthitError(f"{folder} is{plan.part.replace(',', '')} of {plan.config}, which has no cell in it")
        broken = found.unreadable
        damaged = f" ({len(broken)} are unreadable: {broken[0].problem})" if broken else ""
        raise FirsthitError(f"{folder} holds no finished cell{damaged}; run `{plan.command}` first")
    rows = found.columns(parts)
    known = {"key": found.keys, "slot": [plan.slots[key] for key in found.keys]}
    views = columns.frame(rows, {"run": plan.name, "baseline": plan.baseline}, unread, known)
    return Run(
        folder,
        plan,
        _named(views, plan),
        _named(export.frame(FAMILY, found.families), plan),
        export.frame(RUNG, found.rungs),
        tuple(found.unreadable),
        tuple(found.not_run),
        studies,
        {plan.name: folder},
        rows,
    )


def _families(part: Part) -> frozenset[int]:
    """Return the places of the rows of a part that are of families of hard rays."""
    if part.problem:
        return frozenset()
    with damage():
        told = part.file.read(columns=[FAMILY_COLUMN]).column(0).is_valid().to_numpy()
    return frozenset(np.flatnonzero(told).tolist())


def _studies(folder: Path, plan: Plan, found: _Found) -> dict[str, list[dict[str, Any]]]:
    """Read the studies that a plan names."""
    studies: dict[str, list[dict[str, Any]]] = {}
    for name, key in plan.studies.items():
        path = folder / "studies" / f"{key}.json"
        try:
            studies[name] = study_file.read(path, name, key)["rows"]
        except FileNotFoundError:
            found.not_run.append(f"study {name}")
        except (OSError, ValueError) as error:
            found.unreadable.append(Unreadable(f"studies/{path.name}", f"{problem(error)} ({name})"))
    return studies


def _named(frame: pd.DataFrame, plan: Plan) -> pd.DataFrame:
    """Return rows with the names by which readers know their methods and devices."""
    return labels.labelled(_as_told(frame, plan), plan.methods)


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
HELD = 2_000  # rows that are made a table together
_FACTS = ("title", "parameter", "harder", "why", "source")
_FAMILY, _RUNG = map(flattener, (FAMILY, RUNG))
