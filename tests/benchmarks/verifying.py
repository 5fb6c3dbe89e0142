"""Measure `firsthit verify` on many rows, of which some are altered: `python -m tests.benchmarks.verifying`.

Four cells are run on the first usable device, and copied under other names until there are --rows of them. Then one row
of each kind is altered and sealed again, as a forger would. Printed are seconds by the size of the sample and the
number of processes, and which altered rows were found. Nothing is asserted.
"""

from __future__ import annotations

import argparse
import math
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import firsthit
from harness.results import sealed
from harness.results.store import Row
from harness.running.trace import usable_device
from harness.spreading import pool
from harness.verifying.checks import Verified, verify
from tests.many_rows import CONFIG, copies

Alter = Callable[[Path, Row], None]


def _figure(change: Callable[[Row], None]) -> Alter:
    def alter(folder: Path, row: Row) -> None:
        change(row)
        (folder / "cells" / f"{row['key']}.json").write_bytes(sealed.sealed(row))

    return alter


def _array(name: str, change: Callable[[np.ndarray], None]) -> Alter:
    def alter(folder: Path, row: Row) -> None:
        with np.load(folder / row["arrays"]) as file:
            arrays = {each: file[each].copy() for each in file.files}
        change(arrays[name])
        np.savez(folder / row["arrays"], **arrays)

    return alter


def _scale(times: dict[str, Any]) -> None:
    """Halve every time, as a forger does who reads how they follow from their samples."""
    for name, value in times.items():
        if name.endswith("_ms"):
            times[name] = [0.5 * one for one in value] if isinstance(value, list) else 0.5 * value


def _first(array: np.ndarray, value: float) -> None:
    array.ravel()[np.flatnonzero(np.isfinite(array.ravel()))[:1]] = value


def _nearer(array: np.ndarray) -> None:
    array *= np.where(array < np.nanmax(array), 0.5, 1.0).astype(array.dtype)


ALTERED: dict[str, Alter] = {
    "an answer: one ray's status": _array(
        "status", lambda array: array.__setitem__(tuple(np.argwhere(array == 1)[0]), 0)
    ),
    "an answer: one ray's evaluations": _array("evaluations", lambda array: _first(array, 1)),
    "the truth of one ray": _array("truth", lambda array: _first(array, 3)),
    "an error figure, 1 % smaller": _figure(
        lambda row: row["accuracy"]["error"].update(max=0.99 * row["accuracy"]["error"]["max"])
    ),
    "an error in pixels, 1 % smaller": _figure(
        lambda row: row["accuracy"]["pixel_error"].update(p99=0.99 * row["accuracy"]["pixel_error"]["p99"])
    ),
    "a count: one miss less": _figure(lambda row: row["accuracy"].update(truth_hits=row["accuracy"]["truth_hits"] - 1)),
    "a time: the median, 1 % smaller": _figure(
        lambda row: row["time"].update(median_ms=0.99 * row["time"]["median_ms"])
    ),
    "a time: all samples and what follows": _figure(lambda row: _scale(row["time"])),
    "errors of all rays but the largest, halved": _array("error", _nearer),
    "a compile time, halved": _figure(lambda row: row["build"].update(compile_ms=0.5 * row["build"]["compile_ms"])),
}


def main() -> None:
    """Make the rows, alter some, and print what is found and how long it takes."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--rows", type=int, default=10_000)
    parser.add_argument("--side", type=int, default=32, help="rays per side that each row's answers are of")
    parser.add_argument("--samples", default="0,1,100", help="percents of rows whose truth is certified anew")
    parser.add_argument("--jobs", default="1,2")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        config = Path(name) / "few.toml"
        config.write_text(CONFIG.format(device=usable_device().name, side=options.side))
        run = firsthit.run(config, runs=name).folder
        folder = Path(name) / "many"
        rows = copies(run, folder, options.rows)
        step = max(1, len(rows) // len(ALTERED))
        altered = {rows[step * k + k % 4]["key"]: what for k, what in enumerate(ALTERED)}
        for row in rows:
            if row["key"] in altered:
                ALTERED[altered[row["key"]]](folder, row)
        held = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
        print(f"{len(rows):,} rows of {options.side}² rays, {held / len(rows):,.0f} bytes a row with its answers")
        for percent in options.samples.split(","):
            for jobs in map(int, options.jobs.split(",")):
                began = time.perf_counter()
                with pool.over(jobs):
                    found = verify([folder], lambda count, p=float(percent): math.ceil(p / 100 * count), 1)
                told = f"sample {percent} %, {jobs} processes: {time.perf_counter() - began:.1f} s"
                print(f"{told}; {len({one.file for one in found.failing})} rows do not hold", flush=True)
            tell(found, altered)


def tell(found: Verified, altered: dict[str, str]) -> None:
    """Print of each altered row by which figure it was found, and rows that were found without being altered."""
    for key, what in altered.items():
        figures = [f"{one.wrong.figure} ({one.check})" for one in found.failing if one.file.stem == key]
        print(f"  {what}: {', '.join(figures[:3]) or 'not found'}")
    others = {one.file.stem for one in found.failing} - altered.keys()
    print(f"  rows that were not altered and do not hold: {len(others)}")


if __name__ == "__main__":
    main()
