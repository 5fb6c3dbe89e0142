"""Print a config's programs as JSON on the last line of stdout. This runs as a script inside another revision's tree.

The script's arguments are the config, the plugins folder or "", and the names of devices. It uses only what the harness
has in every revision, under the name that it has in each.
"""

import dataclasses
import importlib
import json
import sys
from pathlib import Path
from typing import Any

import harness
from harness.contract import FirsthitError, Program
from harness.plugins import find_methods

LOAD = ("harness.experiment.reading", "harness.experiment.config", "harness.config")  # the newest name first
PLAN = ("harness.experiment.plan", "harness.plan")
DISCOVERY = ("harness.devices.discovery", "harness.devices.executor", "harness.executor")


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
    sections = [[section.origin, section.text] for section in program.sections]
    return {"language": program.language, "precision": program.precision, "entry": program.entry, "sections": sections}


def export(path: str, plugins: str, devices: list[str]) -> dict[str, Any]:
    """Return each cell's programs by its slot. Raises FirsthitError where the config cannot be planned.

    skip: why the cell cannot be run; None where it can
    check, timed: the programs that are checked and timed; None where there is none
    """
    catalog = find_methods(Path(plugins) if plugins else None)
    experiment = _module(LOAD).load(Path(path), catalog)
    experiment = dataclasses.replace(experiment, config=dataclasses.replace(experiment.config, devices=devices))
    found = _module(DISCOVERY).discover_devices(experiment.config.devices)
    planned = _module(PLAN).plan(experiment, catalog, found)
    return {
        p.cell.slot: {
            "skip": p.skip,
            "check": p.checks and _json(p.checks[0]),
            "timed": _json(p.timed) if p.timed else None,
        }
        for p in planned
    }


if __name__ == "__main__":
    try:
        print(json.dumps(export(sys.argv[1], sys.argv[2], sys.argv[3:])))
    except FirsthitError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
