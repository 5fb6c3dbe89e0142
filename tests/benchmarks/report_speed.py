"""Measure how long reports take and how much memory: of made-up runs of many rows, and of runs that are there.

`python -m tests.benchmarks.report_speed 100000` makes up a run of so many rows, of 100 surfaces, in a folder that is
thrown away, and reports it; `python -m tests.benchmarks.report_speed runs/quick runs/papers` reports these. Each report
is made in a process of its own. Nothing here fails for being slow.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from harness.contract import digest
from tests import synthetic_run
from tests.synthetic_run import arrays, cell

SURFACES = 100
PRECISIONS = ("float32", "float64")


def make(folder: Path, rows: int) -> Path:
    """Write a run of `rows` rows into `folder`, with arrays, and return the folder.

    The rows are of SURFACES surfaces, two precisions, one device, and as many settings of the same five variants as
    that takes.
    """
    (folder / "cells").mkdir(parents=True)
    (folder / "arrays").mkdir()
    variants, surfaces = list(synthetic_run.VARIANTS), list(synthetic_run.SURFACES)
    settings = max(1, rows // (SURFACES * len(PRECISIONS) * len(variants)))
    models = {(v, s, p): cell(v, s, "opencl:intel", p) for v in variants for s in surfaces for p in PRECISIONS}
    for (variant, surface, precision), model in models.items():
        if model["arrays"]:
            np.savez(folder / f"{variant} {surface} {precision}.npz", **arrays(model))
    cells = []
    for i in range(min(SURFACES, max(1, rows // (len(PRECISIONS) * len(variants))))):
        like = surfaces[i % len(surfaces)]
        for (variant, surface, precision), model in models.items():
            for setting in range(settings) if surface == like else ():
                made = _again(model, f"{like}_{i}", setting)
                cells.append({name: made[name] for name in ("slot", "key", "family")})
                (folder / "cells" / f"{made['key']}.json").write_text(json.dumps(made))
                if made["arrays"]:
                    os.link(folder / f"{variant} {surface} {precision}.npz", folder / made["arrays"])
    (folder / "plan.json").write_text(json.dumps(synthetic_run.plan(cells)))
    return folder


def _again(model: dict[str, object], surface: str, setting: int) -> dict[str, object]:
    """Return a cell like `model`, of another surface and setting of its variant."""
    variant = str(model["variant"])
    if setting:
        variant = f"{variant.removesuffix(']')}{',' if '[' in variant else '['}STEPS={setting}]"
    slot = f"{variant} {surface} front 256x256x1 {model['precision']} compute {model['device']}"
    key = digest(slot)
    named = {"surface": surface, "surface_title": surface.replace("_", " ").title(), "slot": slot, "key": key}
    named |= {"variant": variant, "parameters": {"STEPS": setting}}
    named |= {"comparison": f"{surface} front 256x256x1 compute"}
    time = model["time"]
    assert isinstance(time, dict)
    return {**model, **named, "time": {**time, "session": surface}, "arrays": model["arrays"] and f"arrays/{key}.npz"}


def measure(run: Path, output: Path, *options: str) -> tuple[float, float]:
    """Report a run in a process of its own; return its seconds, with those of starting, and its peak memory in GB."""
    before = time.perf_counter()
    told = subprocess.run(
        [sys.executable, "-m", "tests.benchmarks.report_speed", "--one", str(run), str(output), *options],
        capture_output=True,
        text=True,
        check=True,
    )
    return time.perf_counter() - before, float(told.stdout.split()[-1]) * 1024 / 1e9


def _one(run: str, output: str, *options: str) -> None:
    """Report a run, and print the peak memory of this process in KiB."""
    from harness.cli import main

    main(["report", run, "-o", output, *options])
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)


def _main(arguments: list[str]) -> None:
    """Measure what the command line names: numbers of rows, and folders of runs."""
    print(f"{'run':24} {'seconds':>8} {'GB':>6} {'PDF, MB':>8} {'HTML, MB':>8}")
    for argument in arguments or ["1000"]:
        with tempfile.TemporaryDirectory() as scratch:
            run = make(Path(scratch, "run"), int(argument)) if argument.isdigit() else Path(argument)
            output = Path(scratch, "made")
            seconds, memory = measure(run, output)
            pdf, html = (output.joinpath(f"report.{form}").stat().st_size / 1e6 for form in ("pdf", "html"))
        name = f"{argument} rows" if argument.isdigit() else run.name
        print(f"{name:24} {seconds:8.1f} {memory:6.2f} {pdf:8.1f} {html:8.1f}", flush=True)


if __name__ == "__main__":
    _one(*sys.argv[2:]) if sys.argv[1:2] == ["--one"] else _main(sys.argv[1:])
