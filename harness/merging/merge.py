"""Merge runs of one config into one folder, which reports, `verify` and `publish` read as any run's."""

from __future__ import annotations

import contextlib
import shutil
import tomllib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError, plural
from harness.merging.choose import Chosen, Twice, choose
from harness.merging.found import Cell, Left, Source, cells_of, lists_of
from harness.results import archive, compaction, pictures_file, plan_file, sealed, study_file
from harness.results.lock import Doing, locked
from harness.results.store import FORMAT, Store, row_of
from harness.results.writing import replacing

Tell = Callable[[str], None]


@dataclass(eq=False)
class Merged:
    """Hold what merging did.

    runs: the runs that were given, by name, each with how many of its rows were taken, and how many cells it has
    rows: cells of the merged run that have a row; `cells` has the others too
    written: files that were written now
    left: what was not merged, and why
    shards: what is missing of the shards, "" for nothing
    unpacked: why rows lie in files although there are very many, "" where they do not
    """

    folder: Path
    runs: dict[str, tuple[int, int]] = field(default_factory=dict)
    cells: int = 0
    rows: int = 0
    written: int = 0
    devices: tuple[str, ...] = ()
    left: list[Left] = field(default_factory=list)
    twice: list[Twice] = field(default_factory=list)
    elsewhere: Counter[str] = field(default_factory=Counter)
    shards: str = ""
    unpacked: str = ""


def merge(
    runs: Sequence[Path],
    output: Path,
    command: str,
    *,
    truth: bool = False,
    wait: bool = False,
    tell: Tell = lambda _: None,
    doing: Doing | None = None,
) -> Merged:
    """Merge runs, folders or archives, into the folder `output`, and say what of them does not fit.

    The first run states the config. `output` is a new folder, or that of an earlier merge, which then counts as the
    run that was named first: merging the same runs again changes nothing. `command` is what a reader of the results may
    type to get them again. With `truth` the oracle's answers are taken over too. Runs are only read.

    Raises FirsthitError where `output` is something else, is written by another process, or cannot be written, and,
    with exit code 3, where nothing can be merged.
    """
    _check_output(output)
    with locked([output], command, wait=wait, doing=doing), contextlib.ExitStack() as stack:
        found = Merged(output)
        earlier = [output] if (output / "plan.json").exists() else []
        sources = list(_sources([*earlier, *runs], stack, found.left))
        if not [one for one in sources if one.folder != output]:
            raise FirsthitError(
                "nothing was merged: " + "; ".join(f"{one.run}: {one.reason}" for one in found.left), exit_code=3
            )
        chosen = choose((cell for one in sources for cell in cells_of(one, found.left, tell)), found.left)
        plan = _plan(sources, chosen, command)
        store = Store(output)
        found.written += _write_plan(store, plan)
        found.written += _write_rows(store, chosen, found, tell)
        found.written += _write_studies(store, sources, plan, found.left)
        if truth:
            found.written += _write_truth(store, sources)
        _count(found, sources, chosen, plan)
    return found


def _check_output(output: Path) -> None:
    """Raise FirsthitError where a folder is neither new nor an earlier merge's."""
    if output.exists() and not output.is_dir():
        raise FirsthitError(f"{output} is a file; name a folder for the merged run")
    if (output / "plan.json").exists():
        if "merged" not in _read_plan(output):
            raise FirsthitError(
                f"{output} is a run of its own and no merged one; name another folder for the merged run"
            )
    elif output.exists() and {one.name for one in output.iterdir()} - {".lock"}:
        raise FirsthitError(f"{output} holds files and is no merged run; name a new folder for the merged run")


def _read_plan(folder: Path) -> dict[str, Any]:
    """Read a run's plan. Raises FirsthitError where there is none that can be read."""
    try:
        return plan_file.read(folder / "plan.json")
    except FileNotFoundError:
        raise FirsthitError(f"there is no run folder {folder}") from None
    except (OSError, ValueError) as error:
        raise FirsthitError(f"plan.json is damaged ({sealed.problem(error)})", exit_code=3) from None


def _sources(runs: Sequence[Path], stack: contextlib.ExitStack, left: list[Left]) -> Iterator[Source]:
    """Yield the runs that are of the config of the first; the others are noted in `left`. Each is read once."""
    first: Source | None = None
    unique: dict[Path, Path] = {}
    for run in runs:
        unique.setdefault(run.resolve(), run)
    for run in unique.values():
        try:
            folder = stack.enter_context(archive.opened(run))
            source = Source(str(run), folder, _read_plan(folder))
        except FirsthitError as error:
            left.append(Left(str(run), "the run", str(error)))
            continue
        if source.plan.get("include"):
            parts = ", ".join(source.plan["include"])
            left.append(Left(source.name, "the run", f"it only collects other runs; merge these one by one: {parts}"))
        elif first and _stated(source) != _stated(first):
            left.append(Left(source.name, "the run", _other_config(source, first)))
        else:
            first = first or source
            yield source


def _stated(source: Source) -> Any:
    """Return what a run's config says, whatever its comments and blanks."""
    text = source.plan["config_text"]
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError):
        return text


def _other_config(source: Source, first: Source) -> str:
    names = source.plan["name"], first.plan["name"]
    return f"it is of another config than {first.name}: " + (
        f"{names[0]}, not {names[1]}" if names[0] != names[1] else f"the text of {names[0]} was changed"
    )


def _plan(sources: Sequence[Source], chosen: Chosen, command: str) -> dict[str, Any]:
    """Make the plan of the merged run."""
    first = sources[0].plan
    studies: dict[str, dict[str, Any]] = {}
    for source in sources:
        for study in source.plan.get("studies", ()):
            before = studies.setdefault(study["study"], study)
            if before is not study and not any(_has_study(one, before) for one in sources):
                studies[study["study"]] = study
    same = ("name", "title", "config", "config_text", "baseline", "focus")
    return {
        **{name: first[name] for name in same if name in first},
        "command": command,
        "created": max(source.plan["created"] for source in sources),
        "environment": first["environment"],
        "devices": _devices(sources, chosen),
        "cells": [_named(cell, chosen) for cell in chosen.cells if cell.listed == "cells"],
        "families": [_named(cell, chosen) for cell in chosen.cells if cell.listed == "families"],
        "family_facts": _union(sources, "family_facts"),
        "methods": _union(sources, "methods"),
        "studies": list(studies.values()),
        "merged": _merged(sources),
    }


def _has_study(source: Source, study: Mapping[str, Any]) -> bool:
    return (source.folder / "studies" / f"{study['key']}.json").exists()


def _union(sources: Sequence[Source], name: str) -> dict[str, Any]:
    """Return what the plans say under a name, the first of them where several say something of one thing."""
    found: dict[str, Any] = {}
    for source in sources:
        found = source.plan.get(name, {}) | found
    return found


def _named(cell: Cell, chosen: Chosen) -> dict[str, Any]:
    """Return what the plan says of a cell."""
    told, device = chosen.told[id(cell)], cell.slot.removeprefix(cell.place)
    return (
        {"slot": cell.slot, "key": cell.key}
        | ({"at": cell.at} if cell.at is not None else {})
        | ({"device": told} if told != device else {})
    )


def _devices(sources: Sequence[Source], chosen: Chosen) -> list[dict[str, Any]]:
    """Return the devices as they are told, each with its machine, in the order in which runs name them."""
    found: dict[str, dict[str, Any]] = {}
    for cell in chosen.cells:
        told = chosen.told[id(cell)]
        stated = next((one for one in cell.source.plan["devices"] if one["name"] == cell.told), None)
        if stated is not None and told not in found:
            machine = (cell.made and cell.made.machine) or cell.source.machine
            here = {"machine": machine, "processor": cell.source.plan["environment"].get("cpu")}
            found[told] = here | stated | {"name": told}
    for source in sources:
        for stated in source.plan["devices"]:
            if stated["name"] not in found and not any(told.startswith(f"{stated['name']}@") for told in found):
                found[stated["name"]] = dict(stated)
    return list(found.values())


def _merged(sources: Sequence[Source]) -> list[dict[str, Any]]:
    """Return what the plan says of the runs that went into it."""
    found: list[dict[str, Any]] = []
    for source in sources:
        told, environment = source.plan, source.plan["environment"]
        own = {"run": Path(source.name).name, "machine": source.machine, "commit": environment.get("commit")}
        own |= {"dirty": bool(environment.get("dirty")), "created": told["created"], "command": told["command"]}
        own |= {"shard": told["shard"]} if "shard" in told else {}
        found += [one for one in told.get("merged", [own]) if one not in found]
    return found


def _write_plan(store: Store, plan: dict[str, Any]) -> int:
    """Write the plan if it is not there yet; return how many files were written.

    It is written before the rows, as by a run, so that a merge that was stopped is gone on with by the same command.
    """
    path = store.folder / "plan.json"
    if path.exists() and path.read_bytes() == sealed.sealed({"format": FORMAT, **plan}):
        return 0
    store.write_plan(plan)
    return 1


def _write_rows(store: Store, chosen: Chosen, found: Merged, tell: Tell) -> int:
    """Write rows, the arrays of each first, and pack them where they are many; return how many files were written."""
    new = [cell for cell in chosen.cells if cell.made and cell.source.folder != store.folder]
    written = 0
    for number, cell in enumerate(new, 1):
        tell(f"writing [{number}/{len(new)}] {cell.slot}")
        try:
            text = cell.source.store.text(cell.key)
            row = row_of(text, cell.key)
        except (OSError, ValueError) as error:
            found.left.append(Left(cell.source.name, cell.source.file_of(cell.key), sealed.problem(error)))
            continue
        if row.get("arrays") is not None:
            file = cell.source.folder / row["arrays"]
            try:
                pictures_file.read(file)
                _copy(file, store.folder / row["arrays"])
                written += 1
            except (OSError, ValueError) as error:
                told = f"{sealed.problem(error)}; the row is merged without its answers ray by ray ({cell.slot})"
                found.left.append(Left(cell.source.name, row["arrays"], told))
        store.write_text(cell.key, text)
        written += 1
        if number % compaction.MOST == 0 or number == len(new):
            found.unpacked = compaction.compact(store.folder).reason
    return written


def _copy(source: Path, target: Path) -> None:
    """Copy a file, whole or not at all. Raises OSError where it cannot be read, FirsthitError where not written."""
    with source.open("rb") as file, replacing(target) as temporary, temporary.open("wb") as copy:
        shutil.copyfileobj(file, copy)


def _write_studies(store: Store, sources: Sequence[Source], plan: Mapping[str, Any], left: list[Left]) -> int:
    written = 0
    for study in plan["studies"]:
        file = f"studies/{study['key']}.json"
        for source in sources:
            if (store.folder / file).exists():
                break
            try:
                study_file.read(source.folder / file, study["study"], study["key"])
            except FileNotFoundError:
                continue
            except (OSError, ValueError) as error:
                left.append(Left(source.name, file, sealed.problem(error)))
                continue
            _copy(source.folder / file, store.folder / file)
            written += 1
    return written


def _write_truth(store: Store, sources: Sequence[Source]) -> int:
    """Take over the oracle's answers; their files are named by all that decides them."""
    written = 0
    for source in sources:
        for file in sorted((source.folder / "truth").glob("*.npz")):
            if not (store.truth / file.name).exists():
                _copy(file, store.truth / file.name)
                written += 1
    return written


def _count(found: Merged, sources: Sequence[Source], chosen: Chosen, plan: Mapping[str, Any]) -> None:
    """Say in `found` what was merged."""
    taken = Counter(cell.source.name for cell in chosen.cells if cell.made)
    for source in sources:
        cells = len(source.plan["cells"]) + len(source.plan.get("families", ()))
        found.runs[source.name] = (taken[source.name], cells)
    found.cells, found.rows = len(chosen.cells), taken.total()
    found.devices = tuple(dict.fromkeys(chosen.told.values()))
    found.twice, found.elsewhere = chosen.twice, chosen.elsewhere
    found.shards = missing_shards(plan["merged"])


def missing_shards(merged: Iterable[Mapping[str, Any]]) -> str:
    """Say which shards are missing of those that a merged run is made of; "" for none."""
    there: dict[int, set[int]] = {}
    for one in merged:
        if "shard" in one:
            there.setdefault(one["shard"]["of"], set()).add(one["shard"]["number"])
    told = []
    for of, numbers in there.items():
        absent = [str(number) for number in range(1, of + 1) if number not in numbers]
        if absent:
            told.append(f"of {plural(of, 'shard')} {len(absent)} are missing: {lists_of(absent, 10)}")
    return "; ".join(told)
