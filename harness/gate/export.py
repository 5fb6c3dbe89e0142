"""Run as a script inside another revision's tree: a config's programs as JSON on the last line of stdout.

Arguments: config, plugins folder or "", device names after them. Uses only what every revision's harness has.
"""

import dataclasses
import importlib
import importlib.util
import json
import sys
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError, Program
from harness.experiment import config, plan
from harness.plugins import find_methods

FINDERS = ("harness.devices.discovery", "harness.devices.executor")  # the newest first


def _discover(devices: list[str]) -> Any:
    """Call discover_devices, in whichever module this revision has it."""
    module = next(name for name in FINDERS if importlib.util.find_spec(name))
    return importlib.import_module(module).discover_devices(devices)


def _json(program: Program) -> dict[str, Any]:
    sections = [[section.origin, section.text] for section in program.sections]
    return {"language": program.language, "precision": program.precision, "entry": program.entry, "sections": sections}


def export(path: str, plugins: str, devices: list[str]) -> dict[str, Any]:
    catalog = find_methods(Path(plugins) if plugins else None)
    experiment = config.load(Path(path), catalog)
    experiment = dataclasses.replace(experiment, config=dataclasses.replace(experiment.config, devices=devices))
    planned = plan.plan(experiment, catalog, _discover(devices))
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
