"""Measure how long reports take and how much memory: of made-up runs of many rows, and of runs that are there.

`python -m tests.benchmarks.report_speed 100000` makes up a run of so many rows, of 100 surfaces, in a folder that is
thrown away, and reports it; `python -m tests.benchmarks.report_speed runs/quick runs/papers` reports these. Printed are
the seconds that making up the rows and their sealed texts took, which in a real run is the work of its cells, those of
storing them and those of the report; the seconds of a core that storing and report took, which others on the machine
change less; and the memory of all of the report's processes together. Each report is made in a process of its own. Of
several sizes the growth of the seconds of a core is told: a line by least squares of the relative deviations, and the
exponent between the two largest sizes, which is 1 where time grows with the rows. So that it is that of one way of
storing, all sizes of a command lie in parts where the largest has more rows than files are kept for, and else in files.
Nothing here fails for being slow.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path

import numpy as np

from harness import memory
from harness.contract import digest
from harness.results import compaction, sealed
from harness.results.store import Row
from tests import synthetic_run
from tests.synthetic_run import arrays, cell

SURFACES = 100
PRECISIONS = ("float32", "float64")
LOOK_SECONDS = 0.1  # between two looks at the memory
PICTURED = 10  # settings whose rows have arrays, of a run whose rows lie in parts


def make(folder: Path, rows: int, packed: bool) -> tuple[float, float]:
    """Write a run of `rows` rows, with arrays; return the seconds that making them up took, and those of a core.

    The rows are of SURFACES surfaces, two precisions, one device, and as many settings of the same five variants as
    that takes. They lie in parts where they are `packed`, else in files.
    """
    (folder / "cells").mkdir(parents=True)
    (folder / "arrays").mkdir()
    variants, surfaces = list(synthetic_run.VARIANTS), list(synthetic_run.SURFACES)
    settings = max(1, rows // (SURFACES * len(PRECISIONS) * len(variants)))
    models = {(v, s, p): cell(v, s, "opencl:intel", p) for v in variants for s in surfaces for p in PRECISIONS}
    for (variant, surface, precision), model in models.items():
        if model["arrays"]:
            np.savez(folder / f"{variant} {surface} {precision}.npz", **arrays(model))
    made = _Timed(_rows(models, surfaces, rows, range(settings), PICTURED if packed else settings))
    store = _parts if packed else _files
    plan = json.dumps(synthetic_run.plan(list(store(folder, made))))
    (folder / "plan.json").write_bytes(sealed.with_seal(f"{{\n{plan[1:]}"))
    return made.seconds, made.of_core


@dataclass(frozen=True)
class _Made:
    """Hold a row that was made up, the sealed bytes of its file, and the name of the model that it is like."""

    row: Row
    text: bytes
    model: str


class _Timed(Iterator[_Made]):
    """Give what an iterator gives, and measure the seconds that it takes, and those of a core."""

    def __init__(self, made: Iterator[_Made]) -> None:
        self.seconds = self.of_core = 0.0
        self._made = made

    def __next__(self) -> _Made:
        since, of_core = time.perf_counter(), time.process_time()
        try:
            return next(self._made)
        finally:
            self.seconds += time.perf_counter() - since
            self.of_core += time.process_time() - of_core


def _rows(
    models: dict[tuple[str, str, str], Row], surfaces: list[str], rows: int, settings: range, pictured: int
) -> Iterator[_Made]:
    """Make up each row; those of the first `pictured` settings have arrays."""
    for i in range(min(SURFACES, max(1, rows // (len(PRECISIONS) * len(synthetic_run.VARIANTS))))):
        like = surfaces[i % len(surfaces)]
        for (variant, surface, precision), model in models.items():
            if surface == like:
                name = f"{variant} {surface} {precision}"
                yield from _settings(model, f"{like}_{i}", settings, pictured, name)


def _settings(model: Row, surface: str, settings: range, pictured: int, name: str) -> Iterator[_Made]:
    """Make up rows like `model`, of another surface and each setting; those of the first `pictured` have arrays."""
    shared = model | {"surface": surface, "surface_title": surface.replace("_", " ").title()}
    shared |= {"comparison": f"{surface} front 256x256x1 compute", "time": model["time"] | {"session": surface}}
    for own in ("key", "slot", "variant", "parameters", "arrays"):
        del shared[own]
    text = json.dumps(shared)[1:]
    for setting in settings:
        variant = str(model["variant"])
        if setting:
            variant = f"{variant.removesuffix(']')}{',' if '[' in variant else '['}STEPS={setting}]"
        slot = f"{variant} {surface} front 256x256x1 {model['precision']} compute {model['device']}"
        key = digest(slot)
        named: Row = {"key": key, "slot": slot, "variant": variant, "parameters": {"STEPS": setting}}
        named["arrays"] = f"arrays/{key}.npz" if model["arrays"] and setting < pictured else None
        yield _Made(shared | named, sealed.with_seal(f"{{\n{json.dumps(named)[1:-1]}, {text}"), name)


def _files(folder: Path, rows: Iterable[_Made]) -> Iterator[Row]:
    """Store rows in files of their own, and yield what a plan says of each."""
    for made in rows:
        (folder / "cells" / f"{made.row['key']}.json").write_bytes(made.text)
        _link(folder, made)
        yield {name: made.row[name] for name in ("slot", "key", "family")}


def _parts(folder: Path, rows: Iterator[_Made]) -> Iterator[Row]:
    """Store rows in Parquet parts, and yield what a plan says of each."""
    names: list[Row] = []

    def stored(some: Iterable[_Made]) -> Iterator[tuple[Row, bytes]]:
        for made in some:
            _link(folder, made)
            names.append({name: made.row[name] for name in ("slot", "key", "family")})
            yield made.row, made.text

    for first in rows:
        compaction.write_part(folder, stored(chain([first], islice(rows, compaction.ROWS - 1))))
    return iter(names)


def _link(folder: Path, made: _Made) -> None:
    """Give a row the arrays of its model."""
    if made.row["arrays"]:
        os.link(folder / f"{made.model}.npz", folder / made.row["arrays"])


def measure(run: Path, output: Path, *options: str) -> tuple[float, float, float]:
    """Report a run in a process of its own; return its seconds, with those of starting, those of a core, and its GB.

    The GB are those of all of the report's processes together.
    """
    before, of_cores, most = time.perf_counter(), _of_children(), 0
    command = [sys.executable, "-m", "tests.benchmarks.report_speed", "--one", str(run), str(output), *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as report:
        watch = memory.Watch(report.pid)
        while report.poll() is None:
            most = max(most, watch.held())
            time.sleep(LOOK_SECONDS)
        told = report.stdout.read() if report.stdout else ""
    seconds = time.perf_counter() - before
    if report.returncode:
        raise subprocess.CalledProcessError(report.returncode, command, told)
    alone = int(told.split()[-1]) * 1024  # its own peak, which two looks may have missed
    return seconds, _of_children() - of_cores, max(most, alone) / 1e9


def _of_children() -> float:
    """Return the seconds of a core that processes took which this one started and which have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _one(run: str, output: str, *options: str) -> None:
    """Report a run, and print the peak memory of this process in KiB."""
    from harness.cli import main

    main(["report", run, "-o", output, *options])
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)


def _main(arguments: list[str]) -> None:
    """Measure what the command line names: numbers of rows, and folders of runs."""
    print(
        f"{'run':15} {'made':>7} {'stored':>7} {'report':>7} {'of a core':>10} {'GB':>6} {'PDF, MB':>8} {'HTML, MB':>9}"
    )
    spent: dict[int, float] = {}
    arguments = arguments or ["1000"]
    packed = any(argument.isdigit() and int(argument) > compaction.MOST for argument in arguments)
    for argument in arguments:
        with tempfile.TemporaryDirectory() as scratch:
            run, told, before = Path(argument), f"{'-':>7} {'-':>7}", 0.0
            if argument.isdigit():
                run, since, of_core = Path(scratch, "run"), time.perf_counter(), time.process_time()
                made, made_of_core = make(run, int(argument), packed)
                told = f"{made:7.1f} {time.perf_counter() - since - made:7.1f}"
                before = time.process_time() - of_core - made_of_core
            output = Path(scratch, "made")
            seconds, of_cores, held = measure(run, output)
            of_cores += before
            pdf, html = (output.joinpath(f"report.{form}").stat().st_size / 1e6 for form in ("pdf", "html"))
        name = run.name
        if argument.isdigit():
            name, spent[int(argument)] = f"{int(argument):,} rows", of_cores
        print(f"{name:15} {told} {seconds:7.1f} {of_cores:10.1f} {held:6.2f} {pdf:8.1f} {html:9.1f}", flush=True)
    if len(spent) > 1:
        print(f"stored in {'parts' if packed else 'files'}: {growth(spent)}")


def growth(spent: Mapping[int, float]) -> str:
    """Tell how the seconds of a core of runs, by their rows, grow; there are at least two."""
    rows, seconds = (np.array(values, float) for values in zip(*sorted(spent.items()), strict=True))
    each, fixed = np.polyfit(rows, seconds, 1, w=1.0 / seconds)
    off = np.abs(np.polyval([each, fixed], rows) / seconds - 1.0).max()
    exponent = np.log(seconds[-1] / seconds[-2]) / np.log(rows[-1] / rows[-2])
    return (
        f"storing and reporting take of a core {fixed:.0f} s and {1e3 * each:.3f} ms a row, within {off:.0%} of each; "
        f"from {rows[-2]:,.0f} to {rows[-1]:,.0f} rows it grows as the rows to the power of {exponent:.2f}"
    )


if __name__ == "__main__":
    _one(*sys.argv[2:]) if sys.argv[1:2] == ["--one"] else _main(sys.argv[1:])
