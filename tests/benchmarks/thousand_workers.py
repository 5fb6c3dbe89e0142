"""Simulate one client with a thousand workers: `python -m tests.benchmarks.thousand_workers`.

What is measured is our own part, the client: it plans, judges answers, makes rows and is the only one that writes. A
few dozen cells are run on the first usable device, with the oracle's answers known already. The processor time of this
process, without planning and without the device's worker, is what the client spends on a cell.

What is simulated is the rest. Each worker takes a cell, holds its device for a time that is drawn (exponential, with
the mean that --seconds states, as a run's [budget] does), and then waits until the client has served it. The client
serves one cell at a time, each in a time drawn from those that were measured: Python threads share one core. So the
simulation tells the truth about where one client saturates, and nothing of a network, of Dask's scheduler or of disks
that are slower than this one's; `python -m tests.benchmarks.cluster` measures the engine's own time for each cell.

Printed are bytes and processor time of 10^6 cells with their price, and throughput, waiting and the client's load for
growing numbers of workers. Nothing is asserted.
"""

from __future__ import annotations

import argparse
import heapq
import random
import statistics
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

import firsthit
from harness import oracle
from harness.contract import Surface, Truth
from harness.results.store import Row, Store
from harness.running.runner import Runner
from harness.running.trace import usable_device

MILLION = 1_000_000
CONFIG = """title = "What a client spends"
surfaces = ["torus", "klein"]
sizes = [64]
devices = ["{device}"]
[[method]]
name = "newton"
parameters = {{ EPSILON = [{epsilons}] }}
[accuracy]
size = {side}
max_wrong_share = 1.0
[budget]
seconds = 0.02
rounds = 8
repetitions = 24
"""


@dataclass
class Spent:
    """Hold what cells cost the client: seconds of processor time and bytes on the disk.

    cells: [n], seconds of each cell
    truths: seconds that the oracle took for each set of rays
    row_bytes, truth_bytes: of a row with its answers, and of a file of truth
    """

    cells: list[float]
    truths: list[float]
    row_bytes: float
    truth_bytes: float


@dataclass(frozen=True)
class Simulated:
    """Hold what became of a simulated run: cells a second, the client's load, and how long workers waited for it."""

    rate: float
    load: float
    waited: float


def measure(cells: int, side: int) -> Spent:
    """Run `cells` cells, of which two sets of rays are certified, and return what they cost."""
    found = Spent([], [], 0.0, 0.0)
    run_, first_hits_, since = Runner._compare, oracle.first_hits, 0.0

    def compared(runner: Runner, group: Sequence[Any]) -> list[Row]:
        nonlocal since
        since, certified = time.process_time(), sum(found.truths)
        rows = run_(runner, group)  # type: ignore[arg-type]
        own = time.process_time() - since - (sum(found.truths) - certified)
        found.cells += [own / len(rows)] * len(rows)
        return rows

    def certified(surface: Surface, rays: NDArray[np.float32], t_min: float = 0.0) -> Truth:
        began = time.process_time()
        truth = first_hits_(surface, rays, t_min)
        found.truths.append(time.process_time() - began)
        return truth

    with tempfile.TemporaryDirectory(prefix="firsthit-bench-") as folder:
        config = Path(folder, "client.toml")
        epsilons = ", ".join(f"{0.1 / (k + 1):.6f}" for k in range(cells // 2))
        config.write_text(CONFIG.format(device=usable_device().name, epsilons=epsilons, side=side))
        with patch.object(Runner, "_compare", compared), patch.object(oracle, "first_hits", certified):
            run = firsthit.run(config, runs=folder, jobs=1)
        held = [sum(f.stat().st_size for f in (run.folder / part).iterdir()) for part in ("cells", "arrays")]
        truths = [file.stat().st_size for file in Store(run.folder).truth.iterdir()]
        found.row_bytes, found.truth_bytes = sum(held) / len(run.rows), statistics.mean(truths)
    return found


def simulate(workers: int, seconds: float, services: Sequence[float], cells: int, seed: int) -> Simulated:
    """Simulate `cells` cells on so many workers that one client serves, the first come first.

    `seconds` is the mean time that a worker holds a cell, `services` are times from which the client's are drawn.
    """
    dice = random.Random(seed)
    ready = [(dice.expovariate(1.0 / seconds), worker) for worker in range(workers)]
    heapq.heapify(ready)
    free, busy, waited = 0.0, 0.0, 0.0
    for _ in range(cells):
        at, worker = heapq.heappop(ready)
        took, begins = dice.choice(services), max(at, free)
        free, busy, waited = begins + took, busy + took, waited + begins - at
        heapq.heappush(ready, (free + dice.expovariate(1.0 / seconds), worker))
    return Simulated(cells / free, busy / free, waited / cells)


def main() -> None:
    """Measure, simulate and print."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--cells", type=int, default=40, help="that are run to measure the client")
    parser.add_argument("--side", type=int, default=64, help="rays per side that answers are of")
    parser.add_argument("--seconds", type=float, default=2.0, help="that a cell holds its device, on average")
    parser.add_argument("--euros", type=float, default=0.04, help="price of an hour of a core")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    spent = measure(options.cells, options.side)
    each, truth = statistics.mean(spent.cells), statistics.mean(spent.truths)
    print(
        f"the client spends {1e3 * each:.1f} ms of a core on a cell of {options.side}² rays ({len(spent.cells)} cells)"
    )
    print(f"the oracle spends {truth:.2f} s of a core on a set of rays; its file has {spent.truth_bytes:,.0f} bytes")
    print(f"a row with its answers has {spent.row_bytes:,.0f} bytes\n")
    for what, seconds in {
        "client": each * MILLION,
        "oracle, if every cell had rays of its own": truth * MILLION,
        "oracle, if 1,000 cells share a set of rays": truth * MILLION / 1000,
        f"devices, at {options.seconds:g} s a cell": options.seconds * MILLION,
    }.items():
        hours = seconds / 3600.0
        print(
            f"10^6 cells, {what}: {hours:,.1f} hours, {options.euros * hours:,.2f} euros at {options.euros:g} an hour"
        )
    print(f"10^6 cells, rows and answers: {spent.row_bytes * MILLION / 1e9:,.1f} GB\n")
    print("workers   cells/s   of what they could   client's load   mean wait")
    for workers in (1, 10, 100, 1000, 10_000):
        made = simulate(workers, options.seconds, spent.cells, 20 * max(workers, 500), options.seed)
        could = made.rate / (workers / options.seconds)
        print(f"{workers:7,} {made.rate:9.1f} {could:20.1%} {made.load:15.1%} {made.waited:9.3f} s")
    print(f"one client saturates at about {options.seconds / each:,.0f} workers, {1 / each:,.0f} cells a second")


if __name__ == "__main__":
    main()
