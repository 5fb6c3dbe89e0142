"""Measure what keeping each round's samples costs a run: `python -m tests.benchmarks.storing [DEVICE] [ROUNDS]`.

Six cells are timed together, on opencl:pocl in 300 rounds without arguments, in a run that is thrown away. Printed are
the milliseconds that storing takes between two rounds, and the share of the time of all rounds that this is. Each
sample that was taken right after storing is held against the median of its cell's others; printed is the median of
these ratios with its 95 % interval. Nothing is asserted.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from unittest.mock import patch

import firsthit
from harness.results.begun import Sample, Session
from harness.results.timings import median_interval

CONFIG = """title = "Storing"
surfaces = ["torus"]
sizes = [64]
precisions = ["float32"]
devices = ["{device}"]
[[method]]
name = "newton"
parameters = {{ EPSILON = [0.1, 0.03, 0.01, 0.003, 0.001, 0.0003] }}
[accuracy]
size = 16
max_wrong_share = 1.0
[budget]
seconds = 1000.0
interval = 0.0
rounds = {rounds}
repetitions = {rounds}
"""


def main(device: str = "opencl:pocl", rounds: str = "300") -> None:
    """Run the config, and print what storing took."""
    spent: list[float] = []
    ends: list[float] = []  # when each round was stored, by the host's clock
    after: dict[str, list[float]] = defaultdict(list)  # ms of a frame that was timed right after storing, by its cell
    others: dict[str, list[float]] = defaultdict(list)
    keep = Session.round

    def timed(session: Session, number: int, samples: Mapping[str, Sample]) -> None:
        for i, (key, sample) in enumerate(samples.items()):  # in the order in which they were taken
            (others if i else after)[key].append(sample[0])
        since = time.perf_counter()
        keep(session, number, samples)
        ends.append(time.perf_counter())
        spent.append(ends[-1] - since)

    with tempfile.TemporaryDirectory(prefix="firsthit-bench-") as folder, patch.object(Session, "round", timed):
        config = Path(folder, "storing.toml")
        config.write_text(CONFIG.format(device=device, rounds=rounds))
        firsthit.run(config, runs=folder)
    share, whole = sum(spent[1:]) / (ends[-1] - ends[0]), ends[-1] - ends[0]
    frames = sorted(statistics.median(each) for each in others.values())
    ratio, lower, upper, _ = median_interval(
        [sample / statistics.median(others[key]) for key, samples in after.items() for sample in samples]
    )
    print(f"{len(others)} cells, {len(spent)} rounds on {device}; frames of {frames[0]:.2f} to {frames[-1]:.2f} ms")
    print(
        f"storing takes {1e3 * statistics.median(spent):.2f} ms a round, {share:.2%} of the {whole:.1f} s of all rounds"
    )
    print(f"samples right after it take {ratio:.3f} times as long as others, 95 % interval {lower:.3f} to {upper:.3f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
