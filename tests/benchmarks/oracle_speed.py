"""Measure what two ways of the oracle save, and what several processes do.

    python -m tests.benchmarks.oracle_speed
    python -m tests.benchmarks.oracle_speed --processes 2 --rays 1000000

The oracle decides most rays together in float64, and leaves the others, the slow rays, to single searches in balls of
more bits. These searches are measured here, on rays of a grid, with a way and without it, in turns. Without pruning, a
minimum keeps all its arguments on each piece of a ray; without Taylor series, pieces on which f's large terms cancel
are only cut and enclosed more precisely. Printed are milliseconds of processor time a ray, and how many rays stay
undecided.

With --processes the rays of a picture of `barth_decic`, of degree 10, are certified by this process alone, on one core,
and by so many, in turns; starting these is part of their time. Then each of so many processes certifies its share of
the rays and shares nothing with the others: that is what the machine allows, whose cores may share caches, memory and
heat. Printed are seconds, and the medians of the turns' ratios. Nothing is asserted.
"""

from __future__ import annotations

import argparse
import contextlib
import math
import os
import statistics
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from unittest.mock import patch

import numpy as np

import surfaces
from harness.contract import Surface, TruthStatus, View
from harness.oracle import first_hits, transcendental
from harness.oracle.reading import graph_of
from harness.oracle.transcendental import SmoothSolver
from harness.scenes.camera import camera_for, rays_of
from harness.spreading import pool
from harness.spreading.serving import THREADS

TURNS = 2
SPHERES = 200


@contextlib.contextmanager
def without_pruning() -> Iterator[None]:
    """Keep every operation of a formula on every piece of a ray."""
    with patch.object(transcendental, "is_prunable", lambda _: False):
        yield


@contextlib.contextmanager
def without_series() -> Iterator[None]:
    """Enclose f by ranges only."""
    with patch.object(transcendental, "WAYS", tuple(way for way in transcendental.WAYS if not way.series)):
        yield


def rays(count: int) -> np.ndarray:
    """Return `count` rays from above, of a grid: origins and directions, count x 6."""
    side = np.linspace(-0.8, 0.8, 6)
    listed = [(x, y, 3.0, 0.1 * x - 0.03, 0.02 - 0.1 * y, -1.0) for x in side for y in side]
    return np.array(listed[:count], np.float32)


def spheres() -> Surface:
    """Return the union of SPHERES spheres, as the minimum of their distances."""
    at = np.random.default_rng(1).integers(-64, 65, (SPHERES, 3)) / 64
    each = (f"sqrt((x-({x}))^2+(y-({y}))^2+(z-({z}))^2)-{(k % 4 + 1) / 16}" for k, (x, y, z) in enumerate(at))
    return surfaces.from_formula(f"min({', '.join(each)})", "sphere:2")


def measure(surface: Surface, listed: np.ndarray) -> tuple[np.ndarray, int]:
    """Return the seconds of processor time that each ray takes, and how many stay undecided."""
    solver, seconds, undecided = SmoothSolver(graph_of(surfaces.tape_of(surface)), surface.domain), [], 0
    for ray in listed.tolist():
        began = time.process_time()
        undecided += solver.first_hit(ray).status == TruthStatus.UNDECIDED
        seconds.append(time.process_time() - began)
    return np.array(seconds[1:]), undecided  # without the first, whose constants are made


def compare_processes(jobs: int, count: int, turns: int) -> None:
    """Certify `count` rays by one process and by `jobs`, in turns, and print how much faster these are."""
    surface = surfaces.get("barth_decic")
    listed = rays_of(camera_for(View("front"), surface), math.isqrt(count))
    first_hits(surface, listed[:100])  # the surface's solver is built once in each process
    ratios: list[tuple[float, float]] = []
    for _ in range(turns):
        taken: list[float] = []
        for number in (1, jobs):
            began = time.perf_counter()
            with pool.over(number):
                first_hits(surface, listed)
            taken.append(time.perf_counter() - began)
        with ProcessPoolExecutor(jobs, get_context("spawn")) as apart:
            taken.append(statistics.mean(apart.map(alone, np.array_split(listed, jobs))))
        ratios.append((taken[0] / taken[1], taken[0] / taken[2]))
        told = f"{len(listed):,} rays of {surface.name}: 1 process {taken[0]:.1f} s, {jobs} {taken[1]:.1f} s"
        told += f", {jobs} that share nothing {taken[2]:.1f} s"
        print(f"{told}; {ratios[-1][0]:.2f} and {ratios[-1][1]:.2f} times as fast", flush=True)
    spread, apart_ratio = (statistics.median(each) for each in zip(*ratios, strict=True))
    print(f"median of {turns}: {spread:.2f} times as fast, where the machine allows {apart_ratio:.2f}")


def alone(listed: np.ndarray) -> float:
    """Certify rays of barth_decic in this process, and return the seconds that it took once the solver was built."""
    surface = surfaces.get("barth_decic")
    first_hits(surface, listed[:100])
    began = time.perf_counter()
    first_hits(surface, listed)
    return time.perf_counter() - began


def main() -> None:
    """Measure what the command line asks for, and print a line for each case."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--processes", type=int, default=0)
    parser.add_argument("--rays", type=int, default=1_000_000)
    parser.add_argument("--turns", type=int, default=1)
    options = parser.parse_args()
    if options.processes:
        if any(os.environ.get(name) != "1" for name in THREADS):  # numpy's library would use all cores for one process
            command = [sys.executable, "-m", "tests.benchmarks.oracle_speed", *sys.argv[1:]]
            os.execve(sys.executable, command, os.environ | dict.fromkeys(THREADS, "1"))
        compare_processes(options.processes, options.rays, options.turns)
        return
    cancels = surfaces.from_formula("cos(x)^2 + sin(x)^2 - 1 + 1e-9*y", "sphere:1.5")
    cases = (
        ("a minimum of 200 spheres, pruned", spheres(), without_pruning),
        ("cos² + sin² − 1 + y/10⁹, by series", cancels, without_series),
    )
    for what, surface, without in cases:
        listed = rays(36)
        taken: dict[str, list[np.ndarray]] = {"with": [], "without": []}
        open_: dict[str, int] = {}
        for _ in range(TURNS):
            for how, context in (("with", contextlib.nullcontext), ("without", without)):
                with context():
                    seconds, open_[how] = measure(surface, listed)
                taken[how].append(seconds)
        for how, found in taken.items():
            each = 1e3 * np.min(found, axis=0)
            told = f"mean {each.mean():.1f} ms, slowest three {np.sort(each)[-3:].mean():.1f} ms a ray"
            print(f"{what}: {how:7} it {told}; {open_[how]} of {len(listed)} rays undecided", flush=True)


if __name__ == "__main__":
    main()
