"""Write a config's programs as JSON. This runs as a script inside another revision's tree.

The script's arguments are the config, the plugins folder or "", a folder that takes WRITTEN and arrays, and the devices
as JSON. It uses only what the harness has in every revision, under the name that it has in each. What a revision
lacks is left out, and whoever reads the JSON says so. Methods may print what they like.
"""

import dataclasses
import importlib
import itertools
import json
import sys
import tomllib
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

import harness
from harness.contract import FirsthitError, Program
from harness.plugins import find_methods

LOAD = ("harness.experiment.reading", "harness.experiment.config", "harness.config")  # the newest name first
PLAN = ("harness.experiment.plan", "harness.plan")
DISCOVERY = ("harness.devices.discovery", "harness.devices.executor", "harness.executor")
WRITTEN = "cells.json"
NOT_PLANNED = ("gate", "accuracy", "baseline")  # keys of a config that decide no program
GROWING = ("method", "surfaces", "families")  # keys whose lists may name what this revision has not


def _module(names: tuple[str, ...]) -> Any:
    """Import the first of these modules that this revision has. Raises FirsthitError where it has none.

    It looks for files of the revision itself, since an editable installation offers modules of another one beside them.
    """
    tree = Path(harness.__file__).parents[1]
    for name in names:
        if tree.joinpath(*name.split(".")).with_suffix(".py").is_file():
            return importlib.import_module(name)
    raise FirsthitError(f"it has none of the modules {', '.join(names)}")


def _json(program: Program) -> dict[str, Any]:
    """Return the parts of a program, from which `harness.gate.revision` makes the program again."""
    parts = {name: getattr(program, name, ()) for name in ("sections", "vertex")}
    texts = {name: [[section.origin, section.text] for section in sections] for name, sections in parts.items()}
    return {"language": program.language, "precision": program.precision, "entry": program.entry} | texts


def _toml(value: Any) -> str:
    """Write a value as TOML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, str | bool):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return repr(value)


def _absent(methods: Any, catalog: Any) -> dict[str, str]:
    """Return the methods of a config that this revision does not have at all, by name, each with a sentence on that.

    `methods` is what the file holds, which may be anything; a part that is no method is left to the reading of it.
    """
    items = methods if isinstance(methods, list) else []
    names = [str(item["name"]) for item in items if isinstance(item, dict) and isinstance(item.get("name"), str)]
    if len(names) < len(items):
        return {}
    known = catalog.plugins.keys() | getattr(catalog, "broken", {}).keys()
    return {name: f"it has no method {name!r}" for name in names if name not in known}


def _catalog(plugins: Path | None) -> Any:
    """Find the methods of this revision; without the folder for --plugins where no method is in that yet."""
    try:
        return find_methods(plugins)
    except FirsthitError:
        if plugins is not None and not [*plugins.glob("method.py"), *plugins.glob("*/method.py")]:
            return find_methods(None)
        raise


def load(path: Path, catalog: Any, folder: Path) -> tuple[Any | None, dict[str, str]]:
    """Read the config with this revision's code.

    Methods, surfaces and families that this revision cannot read, since they came later, are left out. Returns the
    experiment, and why each was left out, by its name. The experiment is None where this revision has none of the
    methods. Raises FirsthitError where nothing else is left that can be read.
    """
    reading = _module(LOAD)
    try:
        return reading.load(path, catalog), {}
    except FirsthitError as error:
        first = error
    try:
        whole = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise first from None
    whole = {key: value for key, value in whole.items() if key not in NOT_PLANNED}
    absent = _absent(whole.get("method"), catalog)
    if absent:
        whole["method"] = [item for item in whole["method"] if item["name"] not in absent]
        if not whole["method"]:
            return None, absent
    copy = folder / path.name

    def attempt(parts: dict[str, Any]) -> Any:
        lines = (f"{json.dumps(key)} = {_toml(value)}" for key, value in (whole | parts).items())
        copy.write_text("\n".join(lines), encoding="utf-8")
        return reading.load(copy, catalog)

    def refusal(parts: dict[str, Any]) -> str | None:
        try:
            attempt(parts)
        except FirsthitError as error:
            return str(error).partition(": ")[2] or str(error)
        return None

    lists = {key: whole[key] for key in GROWING if isinstance(whole.get(key), list)}
    choices = itertools.product(*([[item] for item in items] for items in lists.values()))
    read = next((c for c in (dict(zip(lists, choice, strict=True)) for choice in choices) if not refusal(c)), None)
    if read is None:
        raise first
    kept: dict[str, list[Any]] = {key: [] for key in lists}
    left_out = dict(absent)
    for key, item in ((key, item) for key, items in lists.items() for item in items):
        if reason := refusal(read | {key: [item]}):
            left_out[str(item.get("name") if isinstance(item, dict) else item)] = reason
        else:
            kept[key].append(item)
    return attempt(kept), left_out


def _second(casting: Any) -> Program | None:
    """Return the kernel as an OpenCL program of listed rays, for a second build of it; None where there is none."""
    try:
        second = casting.second_build(None, SimpleNamespace(rays=None))
        if second and hasattr(second, "programs"):
            alone, *others = second.programs("cl")
            return None if others else alone
        return second.program("cl") if second else None
    except (AttributeError, TypeError, FirsthitError):  # a revision without second builds, or with others
        return None


def _batches(casting: Any, folder: Path, name: str) -> list[str]:
    """Write what each draw call of stage raster draws into files of `folder`, and return their paths."""
    files = []
    for i, draw in enumerate(getattr(casting, "draws", ())):
        batch = draw.batch(True)
        arrays = {"instances": batch.instances, "triangles": batch.triangles, "closed": np.array(batch.closed)}
        arrays |= {} if batch.vertices is None else {"vertices": batch.vertices}
        files.append(str(folder / f"{name}-{i}.npz"))
        np.savez(files[-1], **arrays)
    return files


def _tables(casting: Any, folder: Path, name: str) -> dict[str, str]:
    """Write each table that belongs to a casting's programs into a file of `folder`, and return the paths by name."""
    tables = getattr(casting, "tables", None)
    if tables is None:  # tiles came before castings told their tables
        frame = casting.frame() if getattr(casting.timed, "entry", None) == "isolate" else None
        tables = {"fourths": frame.fourths} if frame else {}
    files = {}
    for i, (table, values) in enumerate(tables.items()):
        files[table] = str(folder / f"{name}-table-{i}.npy")
        np.save(files[table], values)
    return files


def _cell(planned: Any, catalog: Any, folder: Path, name: str) -> dict[str, Any]:
    """Return what `harness.gate.revision.Former` holds of a cell, as far as this revision says it."""
    casting, skip = getattr(planned, "casting", None), planned.skip
    variant, batches, tables = getattr(planned.cell, "variant", None), [], {}
    try:
        batches = _batches(casting, folder, name)
        tables = _tables(casting, folder, name) if casting else {}
    except FirsthitError as error:  # a mesh or a table that cannot be made
        skip = str(error)
    method = catalog.get(variant.method).method if variant else None
    before = getattr(planned, "prepass", None)  # where it is in a revision without castings
    second, others = _second(casting), getattr(casting, "others", (before,) if before else ())
    return {
        "skip": skip,
        "failure": getattr(planned, "failure", None),
        "checks": [_json(program) for program in planned.checks or ()],
        "timed": _json(planned.timed) if planned.timed else None,
        "others": [_json(program) for program in others],
        "second": _json(second) if second else None,
        "batches": batches,
        "tables": tables,
        "parameters": dict(variant.parameters) if variant else {},
        "method": variant.method if variant else None,
        "claims": sorted(method.claims) if method else None,
        "identity": getattr(planned, "identity", {}),
    }


def export(path: Path, plugins: str, folder: Path, devices: list[str], own: dict[str, list[str]]) -> dict[str, Any]:
    """Return each cell by its slot, and what was left out, by its name. Raises FirsthitError as `load` does.

    Cells are on `devices`, and those of the variants named in `own` on the devices there.
    """
    catalog = _catalog(Path(plugins) if plugins else None)
    if hasattr(catalog, "with_stand_ins"):  # the cells of a method that cannot be loaded there fail there
        catalog = catalog.with_stand_ins()
    experiment, left_out = load(path, catalog, folder)
    if experiment is None:
        return {"cells": {}, "left_out": left_out}
    experiment = dataclasses.replace(experiment, config=dataclasses.replace(experiment.config, devices=devices))
    if hasattr(experiment, "own_devices"):
        of = {variant: tuple(own[str(variant)]) for variant in experiment.variants if str(variant) in own}
        experiment = dataclasses.replace(experiment, own_devices=of)
    found = _module(DISCOVERY).discover_devices([*devices, *(name for names in own.values() for name in names)])
    planned = _module(PLAN).plan(experiment, catalog, found)
    cells = {p.cell.slot: _cell(p, catalog, folder, str(i)) for i, p in enumerate(planned)}
    return {"cells": cells, "left_out": left_out}


if __name__ == "__main__":
    try:
        cells = export(Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3]), **json.loads(sys.argv[4]))
        Path(sys.argv[3], WRITTEN).write_text(json.dumps(cells), encoding="utf-8")
    except FirsthitError as error:
        print(" ".join(str(error).split()), file=sys.stderr)
        sys.exit(2)
