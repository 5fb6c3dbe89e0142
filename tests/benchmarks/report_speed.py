"""Measure how long reports take and how much memory: of made-up runs of many rows, and of runs that are there.

`python -m tests.benchmarks.report_speed 100000` makes up a run of so many rows, of 100 surfaces, in a folder that is
thrown away, and reports it; `python -m tests.benchmarks.report_speed runs/quick runs/papers` reports these. Printed are
the seconds that storing the rows took, with making them up, and those of the report. Each report is made in a process
of its own. Nothing here fails for being slow.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from itertools import chain, islice
from pathlib import Path

import numpy as np

from harness.contract import digest
from harness.results import compaction, sealed
from harness.results.store import Row
from tests import synthetic_run
from tests.synthetic_run import arrays, cell

SURFACES = 100
PRECISIONS = ("float32", "float64")
PICTURED = 10  # settings whose rows have arrays, of a run with more rows than files are kept for


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
    made = _rows(models, surfaces, rows, settings)
    cells = list(_parts(folder, made) if rows > compaction.MOST else _files(folder, made))
    (folder / "plan.json").write_text(json.dumps(synthetic_run.plan(cells)))
    return folder


def _rows(
    models: dict[tuple[str, str, str], Row], surfaces: list[str], rows: int, settings: int
) -> Iterator[tuple[Row, str]]:
    """Make up each row, with the name of the model that it is like."""
    for i in range(min(SURFACES, max(1, rows // (len(PRECISIONS) * len(synthetic_run.VARIANTS))))):
        like = surfaces[i % len(surfaces)]
        for (variant, surface, precision), model in models.items():
            for setting in range(settings) if surface == like else ():
                yield _again(model, f"{like}_{i}", setting), f"{variant} {surface} {precision}"


def _files(folder: Path, rows: Iterable[tuple[Row, str]]) -> Iterator[Row]:
    """Store rows in files of their own, and yield what a plan says of each."""
    for row, model in rows:
        (folder / "cells" / f"{row['key']}.json").write_text(json.dumps(row))
        _link(folder, row, model)
        yield {name: row[name] for name in ("slot", "key", "family")}


def _parts(folder: Path, rows: Iterable[tuple[Row, str]]) -> Iterator[Row]:
    """Store rows in Parquet parts, and yield what a plan says of each; only the first PICTURED settings have arrays."""
    names: list[Row] = []

    def stored(some: Iterable[tuple[Row, str]]) -> Iterator[tuple[Row, bytes]]:
        for row, model in some:
            if row["parameters"]["STEPS"] < PICTURED:
                _link(folder, row, model)
            else:
                row["arrays"] = None
            names.append({name: row[name] for name in ("slot", "key", "family")})
            yield row, sealed.with_seal("{\n" + json.dumps(row)[1:])

    waiting = iter(rows)
    for first in waiting:
        compaction.write_part(folder, stored(chain([first], islice(waiting, compaction.ROWS - 1))))
    return iter(names)


def _link(folder: Path, row: Row, model: str) -> None:
    """Give a row the arrays of its model."""
    if row["arrays"]:
        os.link(folder / f"{model}.npz", folder / row["arrays"])


def _again(model: Row, surface: str, setting: int) -> Row:
    """Return a cell like `model`, of another surface and setting of its variant."""
    variant = str(model["variant"])
    if setting:
        variant = f"{variant.removesuffix(']')}{',' if '[' in variant else '['}STEPS={setting}]"
    slot = f"{variant} {surface} front 256x256x1 {model['precision']} compute {model['device']}"
    key = digest(slot)
    named = {"surface": surface, "surface_title": surface.replace("_", " ").title(), "slot": slot, "key": key}
    named |= {"variant": variant, "parameters": {"STEPS": setting}}
    named |= {"comparison": f"{surface} front 256x256x1 compute"}
    return {
        **model,
        **named,
        "time": {**model["time"], "session": surface},
        "arrays": model["arrays"] and f"arrays/{key}.npz",
    }


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
    print(f"{'run':24} {'stored, s':>10} {'report, s':>10} {'ms a row':>9} {'GB':>6} {'PDF, MB':>8} {'HTML, MB':>9}")
    for argument in arguments or ["1000"]:
        with tempfile.TemporaryDirectory() as scratch:
            since = time.perf_counter()
            run = make(Path(scratch, "run"), int(argument)) if argument.isdigit() else Path(argument)
            stored = f"{time.perf_counter() - since:.1f}" if argument.isdigit() else "-"
            output = Path(scratch, "made")
            seconds, memory = measure(run, output)
            pdf, html = (output.joinpath(f"report.{form}").stat().st_size / 1e6 for form in ("pdf", "html"))
        each = f"{1e3 * seconds / int(argument):.3f}" if argument.isdigit() else "-"
        name = f"{argument} rows" if argument.isdigit() else run.name
        print(f"{name:24} {stored:>10} {seconds:10.1f} {each:>9} {memory:6.2f} {pdf:8.1f} {html:9.1f}", flush=True)


if __name__ == "__main__":
    _one(*sys.argv[2:]) if sys.argv[1:2] == ["--one"] else _main(sys.argv[1:])
