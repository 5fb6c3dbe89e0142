"""Race two revisions' programs of a cell: both draw frames in interleaved rounds of one run on one device."""

from __future__ import annotations

import itertools
import math
import time
from collections.abc import Mapping
from dataclasses import replace

from harness.contract import CellStatus
from harness.devices.executor import CellError, LocalExecutor
from harness.experiment.config import Experiment
from harness.experiment.kinds.model import RacedCasting
from harness.experiment.plan import Planned, shuffled
from harness.gate.judge import Change, Judged, Tolerance, Verdict
from harness.results import timings
from harness.results.figures import SPEED
from harness.results.timings import Ratio

MINIMUM_ROUNDS = 10
NARROW = 0.5  # of the tolerance: an interval of this width says enough
Sides = Mapping[str, RacedCasting]


def tolerance_of(experiment: Experiment) -> Tolerance | None:
    """Return how much slower a frame may get; None where the config does not want speed gated."""
    own = experiment.config.gate.figures.get(SPEED.name)
    if own is None:
        return Tolerance("lower", 0.0, SPEED.relative)
    return Tolerance("lower", own.absolute, own.relative) if own.gated else None


def race(
    base: Judged, planned: Planned, sides: Sides, experiment: Experiment, tolerance: Tolerance, executor: LocalExecutor
) -> Judged:
    """Return `base` with the verdict of a race between the castings `now` and `then` of a cell.

    A failure while running is a verdict too, and raises nothing.
    """
    try:
        return verdict_of(base, _ratio(planned, sides, experiment, tolerance, executor), tolerance)
    except CellError as error:
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=str(error))


def verdict_of(base: Judged, ratio: Ratio | None, tolerance: Tolerance) -> Judged:
    """Return `base` with the verdict that a ratio of times, now over then, allows.

    It is regressed only where the whole interval of the ratio is above what the tolerance allows, and improved only
    where the whole interval is below 1 by as much. A ratio of too few rounds, or that is no number, is incomparable.
    """
    if ratio is None or not ratio.proved:
        rounds = ratio.pairs if ratio else 0
        reason = f"{rounds} rounds prove nothing; raise [budget] seconds"
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=reason)
    allowed = tolerance.allowed(1.0)
    slack = allowed - 1.0
    if not all(map(math.isfinite, (ratio.lower, ratio.upper))):
        return replace(base, verdict=Verdict.INCOMPARABLE, reason="the times' ratio is no number")
    kept, better = ratio.lower <= allowed, ratio.upper < 1.0 - slack
    verdict = Verdict.IMPROVED if better else Verdict.PASS if kept else Verdict.REGRESSED
    told = f"time over the other revision's, in {ratio.lower:.3f} to {ratio.upper:.3f} (95 %, {ratio.pairs} rounds)"
    return replace(
        base, verdict=verdict, reason=told, changes=(Change(SPEED.name, 1.0, ratio.median, allowed, verdict),)
    )


def _ratio(
    planned: Planned, sides: Sides, experiment: Experiment, tolerance: Tolerance, executor: LocalExecutor
) -> Ratio | None:
    """Time both programs once in each round, in random order, and return the ratio of their times, now over then.

    Rounds go on until the ratio's interval is narrow or the budget is spent. Raises CellError where a frame fails or
    the device's clock tells no time.
    """
    budget = experiment.config.budget
    assert planned.device
    frames = {side: frame for side, casting in sides.items() if (frame := casting.frame())}
    device, keys = planned.cell.device, {side: f"{planned.key} {side}" for side in sides}
    batches = {side: executor.warm(device, keys[side], frame).batch for side, frame in frames.items()}
    batch = max(batches.values())
    times: dict[str, list[float]] = {side: [] for side in sides}
    start, ratio = time.perf_counter(), None
    for round_number in itertools.count():
        for side in shuffled(list(sides), experiment.config.seed, round_number):
            timing = executor.sample(device, keys[side], frames[side], batch)
            told = timing.device_ms if planned.device.clock == "device" else timing.wall_ms
            if not told or not math.isfinite(told):  # a time by the other clock could not be paired with these
                raise CellError(CellStatus.FAILED, f"the {planned.device.clock}'s clock told {told} for a frame")
            times[side].append(told)
        rounds = range(round_number + 1)
        ratio = timings.paired_ratio(times["now"], rounds, times["then"], rounds)
        assert ratio
        narrow = ratio.proved and ratio.upper - ratio.lower <= NARROW * tolerance.relative * ratio.median
        spent = time.perf_counter() - start >= 2.0 * budget.seconds
        if len(rounds) >= MINIMUM_ROUNDS and (narrow or spent or len(rounds) >= budget.repetitions):
            break
    for side in sides:
        executor.release(device, keys[side])
    return ratio
