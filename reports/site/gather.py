"""Read many runs as one: rows that know their run, machine and scene, and what could not be read."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pandas as pd

from harness.contract import CellStatus, FirsthitError, digest
from harness.results.store import Store
from reports import labels, wording
from reports.analysis import breaks, derive
from reports.claims import Claim, Outcome, Verdict
from reports.material import Material
from reports.reading import load
from reports.reading.arrays import Shelf
from reports.reading.run import Plan, Run
from reports.site.markup import slug

DEGREES = (  # of a surface that no group of the gallery names: the largest degree, and what its class is called
    (2, "Planes and quadrics"),
    (3, "Cubics"),
    (4, "Quartics"),
    (6, "Degree 5 and 6"),
    (8, "Degree 7 and 8"),
)
HIGHER, NO_POLYNOMIAL, SCENES = "Degree 9 and more", "Not algebraic", "Scenes of several instances"


@dataclass(frozen=True, eq=False)
class Part:
    """Hold one run: its name on the site, its plan, and what of it cannot be shown."""

    id: str  # its page is runs/ID.html
    plan: Plan
    folder: Path
    machine: str  # those of all its devices
    rows: pd.DataFrame  # all rows of views, with the site's columns
    families: int  # ladders of hard rays
    studies: tuple[str, ...]
    not_run: int
    problems: tuple[str, ...]

    @property
    def commit(self) -> str:
        """Write the commits (Plan.commits); a dash where the plan does not tell."""
        return wording.listed(self.plan.commits) or wording.NONE


@dataclass(frozen=True, eq=False)
class Gathered:
    """Hold all runs of a site.

    frame: derive.derive's columns, those of `labels`, and `at` (the run's id), `processor`, `on` (the device, told
        apart from those of other machines), `driver`, `created`, `kind` (the class of the surface), `page` (of the
        surface), `clear_rays` (see `_clear_rays`)
        and `scene_id`, which two rows share that were cast from the same view of the same surface
    methods: what the newest run that has a method stores of it, by name
    verdicts: the papers' claims that a run decides, with the title of that run
    problems: a sentence for each run, or file of one, that could not be used
    """

    frame: pd.DataFrame
    parts: tuple[Part, ...]
    methods: Mapping[str, Mapping[str, Any]]
    verdicts: tuple[tuple[Claim, Verdict, str], ...]
    problems: tuple[str, ...]
    shelf: Shelf

    def with_problems(self, more: Iterable[str]) -> Gathered:
        """Return the same with further problems, each told once."""
        return replace(self, problems=tuple(dict.fromkeys([*self.problems, *more])))

    def part(self, name: str) -> Part:
        """Return the run of this id."""
        return next(part for part in self.parts if part.id == name)


def gather(folders: Sequence[Path]) -> Gathered:
    """Read the runs in `folders`, and those that they collect, each once.

    A run that cannot be read is a sentence of `problems`. Raises FirsthitError where none can.
    """
    problems: list[str] = []
    loaded: list[tuple[Run, pd.DataFrame]] = []
    for folder in folders:
        try:
            run = load.load(folder)
            loaded.append((run, derive.derive(run.frame, run.plan.peaks)))
        except FirsthitError as error:
            problems.append(str(error))
    if not loaded:
        raise FirsthitError("no run could be read: " + "; ".join(problems))
    verdicts = tuple(found for run, frame in loaded for found in _verdicts(run, frame))
    parts = _parts(loaded)
    problems += [f"{part.plan.name}: {problem}" for part in parts for problem in part.problems]
    problems += [
        f"{run.plan.name}: {u.file}: {u.problem}" for run, _ in loaded for u in run.unreadable if _whole(run, u.file)
    ]
    methods: dict[str, Mapping[str, Any]] = {}
    for part in sorted(parts, key=lambda part: part.plan.created):
        for name, told in part.plan.methods.items():
            methods[name] = {"label": methods.get(name, {}).get("label"), **told}  # older runs store none
    every = pd.concat([part.rows for part in parts], ignore_index=True)
    every = labels.labelled(every.assign(on=_devices(every), page=_pages(every)), methods)
    shelf = Shelf({part.id: part.folder for part in parts})
    return Gathered(every, parts, methods, verdicts, tuple(dict.fromkeys(problems)), shelf)


def _whole(run: Run, file: str) -> bool:
    """Tell whether a file that could not be read is a run that a collection names, not a file of one of its runs."""
    return bool(run.plan.include) and file in run.plan.include


def _verdicts(run: Run, frame: pd.DataFrame) -> list[tuple[Claim, Verdict, str]]:
    """Judge the papers' claims by one run or one collection; those that it decides."""
    material = Material(run, frame, breaks.derive(run.families, run.rungs), Shelf(run.folders))
    title = run.plan.title or run.plan.name
    return [(claim, found, title) for claim, found in material.judged if found.outcome is not Outcome.UNTESTED]


def _parts(loaded: Iterable[tuple[Run, pd.DataFrame]]) -> tuple[Part, ...]:
    """Take collections apart, so that every run is there once, in the order given."""
    found: dict[Path, tuple[str, Plan, Run, pd.DataFrame]] = {}
    for run, frame in loaded:
        for name, folder in run.folders.items():
            plan = load.plan_of(folder)
            found.setdefault(folder.resolve(), (name, plan, run, frame[frame["run"] == name]))
    taken: set[str] = set()
    plans = [plan for _, plan, _, _ in found.values()]
    systems = dict(_machine(plan) for plan in reversed(plans))
    each = [_machines(plan, systems) for plan in plans]
    named = list(dict.fromkeys(machine for own in each for machine in own.values()))
    machines = dict(zip(named, told_apart(named), strict=True))
    parts = []
    for (folder, (name, plan, run, frame)), of_devices in zip(found.items(), each, strict=True):
        told_of = {device: machines[machine] for device, machine in of_devices.items()}
        within = f"{name}/" if run.plan.include else ""
        told = tuple(
            f"{u.file.removeprefix(within)}: {u.problem}"
            for u in run.unreadable
            if u.file.startswith(within) and not _whole(run, u.file)
        )
        ladders = int((run.families["run"] == name).sum()) if len(run.families) else 0
        own = tuple(study for study in plan.studies if study in run.studies)
        store = Store(folder)
        missing = len(plan.slots.keys() - set(store.keys()))
        made = slug(plan.name, taken)
        forged = ~_own_keys(frame, plan)
        told += tuple(
            f"{store.place(row.key).relative_to(folder).as_posix()}: its key is not that of its contents ({row.slot})"
            for row in frame[forged].itertuples()
        )
        rows = _rows(frame[~forged], made, told_of, plan)
        there = [told for device, told in told_of.items() if device] or [told_of[""]]
        machine = wording.listed(list(dict.fromkeys(there)))
        parts.append(Part(made, plan, folder, machine, rows, ladders, own, missing, told))
    return tuple(parts)


def _own_keys(frame: pd.DataFrame, plan: Plan) -> pd.Series:
    """Tell for each row whether its key is the hash of its slot and of what decides it.

    The slot is the plan's, since that of a row of a merged run tells the device with its machine.

    Returns bool with the index of `frame`.
    """
    own = [
        isinstance(row.identity, str) and digest(plan.slots[row.key], json.loads(row.identity)) == row.key
        for row in frame.itertuples()
    ]
    return pd.Series(own, frame.index, dtype=bool)


def _machine(plan: Plan) -> tuple[str, str]:
    """Return what tells the machine that a plan is of, the shortest name first: its processor and its system."""
    told = plan.environment
    return str(told.get("cpu") or "unknown processor"), str(told.get("platform") or "unknown system")


def _machines(plan: Plan, systems: Mapping[str, str]) -> dict[str, tuple[str, str]]:
    """Return by the name of each device what tells its machine, as `_machine` does; "" stands for any other device.

    A merged run states the environment of the first run that went into it, and the processor with each device. Another
    processor's system is that of `systems`, which has those of other runs by their processors.
    """
    own = _machine(plan)
    processors = {str(device.get("name")): str(device.get("processor") or own[0]) for device in plan.devices}
    others = {name: (cpu, systems.get(cpu, "unknown system")) for name, cpu in processors.items() if cpu != own[0]}
    return {"": own, **dict.fromkeys(processors, own), **others}


def told_apart(names: Sequence[tuple[str, ...]]) -> list[str]:
    """Write each of `names` by as many of its parts, from the first on, as tell it from every other one.

    Equal ones are written alike.
    """
    made = []
    for name in names:
        others = {other for other in names if other != name}
        length = next((i for i in range(1, len(name)) if all(o[:i] != name[:i] for o in others)), len(name))
        made.append(", ".join(dict.fromkeys(name[:length])))
    return made


def _rows(frame: pd.DataFrame, run: str, machines: Mapping[str, str], plan: Plan) -> pd.DataFrame:
    """Add the site's columns to the rows of one run; its comparisons are told apart from those of other runs.

    `machines` names the machine of each device, as `_machines` does.
    """
    drivers = {str(device.get("name")): str(device.get("driver") or "") for device in plan.devices}
    titles = {str(device.get("name")): str(device.get("title") or "") for device in plan.devices}
    prefix = f"{plan.name}: "
    plain = [str(text).removeprefix(prefix) for text in frame["comparison"]]
    scenes = [_scene(*pair) for pair in zip(plain, frame["identity"], strict=True)]
    return frame.assign(
        comparison=[f"{run}: {text}" for text in plain],
        run=run,
        at=run,
        processor=frame["device"].map(machines).fillna(machines[""]),
        driver=frame["device"].map(drivers),
        hardware=frame["device"].map(titles),
        created=plan.created,
        clear_rays=derive.clear_rays(frame),
        scene_id=pd.Series(scenes, frame.index, dtype=object),
        kind=pd.Series([_class(row) for row in frame.itertuples()], frame.index, dtype=object),
    )


def _scene(comparison: str, identity: Any) -> str:
    """Name what is cast: the comparison, and surface and view with all their parameters; runs may share it."""
    stored = json.loads(identity) if isinstance(identity, str) else {}
    return digest(comparison, [stored.get(name) for name in ("surface", "view", "scene")])


def _class(row: Any) -> str:
    """Return the class of a row's surface: its group of the gallery, else by its degree."""
    if not wording.absent(row.scene):
        return SCENES
    if not wording.absent(row.surface_group) and row.surface_group != "catalog":
        return str(row.surface_group).replace("_", " ").capitalize()
    if wording.absent(row.degree):
        return NO_POLYNOMIAL
    return next((name for most, name in DEGREES if row.degree <= most), HIGHER)


def _devices(frame: pd.DataFrame) -> pd.Series:
    """Return the name of each row's device, with hardware, driver and machine where others have its name too."""
    told = ["device", "hardware", "driver", "processor"]
    every = list(frame[told].fillna("").drop_duplicates().itertuples(index=False, name=None))
    named = dict(zip(every, told_apart(every), strict=True))
    return pd.Series([named[row] for row in frame[told].fillna("").itertuples(index=False, name=None)], frame.index)


def _pages(frame: pd.DataFrame) -> pd.Series:
    """Return the name of each row's surface page: surfaces that share a name and not a formula have pages apart."""
    taken: set[str] = set()
    keys = list(frame[["surface", "formula"]].itertuples(index=False, name=None))
    named = {key: slug(str(key[0]), taken) for key in dict.fromkeys(keys)}
    return pd.Series([named[key] for key in keys], frame.index, dtype=object)


def failed(rows: pd.DataFrame) -> pd.DataFrame:
    """Select the rows that did not end well; skipped ones could not be cast there, and are no failures."""
    return rows[~rows["status"].isin([CellStatus.OK, CellStatus.SKIPPED])]
