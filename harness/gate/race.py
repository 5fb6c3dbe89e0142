"""Race two revisions' programs of a cell: both draw frames in interleaved rounds of one run on one device.

**By which clock** A device that computes on this machine's processor is timed by what its process spends on the
processor, all threads together. Other programs take the processor away from a frame, but they do not change what the
frame spends. Times of a GPU are by the clock that its probes support. So a program on the processor that only
distributes the same work worse over its cores is not found to be slower.

**Measured** 512 × 512 rays of a torus on two cores of opencl:intel while other programs asked for eleven, the same
program against itself: in six seconds the ratio's interval is 0.995 to 1.001 by the processor's clock, and 0.90 to 1.10
by the host's and the device's.
"""

from __future__ import annotations

import itertools
import math
import time
from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

from harness.contract import CellStatus, DeviceInfo, plural
from harness.devices.executor import CellError
from harness.devices.interface import Timing
from harness.devices.steps import Executor
from harness.experiment.config import Experiment
from harness.experiment.kinds.model import RacedCasting
from harness.experiment.plan import Planned, shuffled
from harness.gate.judge import Change, Judged, Tolerance, Verdict
from harness.results import timings
from harness.results.figures import SPEED
from harness.results.timings import Ratio

MINIMUM_ROUNDS = 10
NARROW = 0.5  # of the tolerance: an interval of this width says enough
LONGEST = 8  # times the budget: what a race may take whose interval reaches from what is allowed to what is not
TOLD = "time over the other revision's, in "
Sides = Mapping[str, RacedCasting]
Clock = Literal["device", "wall", "processor"]


def tolerance_of(experiment: Experiment) -> Tolerance | None:
    """Return how much slower a frame may get; None where the config does not want speed gated, or times nothing."""
    if experiment.config.budget.seconds == 0.0:
        return None
    own = experiment.config.gate.figures.get(SPEED.name)
    if own is None:
        return Tolerance("lower", 0.0, SPEED.relative)
    return Tolerance("lower", own.absolute, own.relative) if own.gated else None


def race(
    base: Judged, planned: Planned, sides: Sides, experiment: Experiment, tolerance: Tolerance, executor: Executor
) -> Judged:
    """Return `base` with the verdict of a race between the castings `now` and `then` of a cell.

    A failure while running is a verdict too, and raises nothing.
    """
    try:
        told = verdict_of(base, _ratio(planned, sides, experiment, tolerance, executor), tolerance)
    except CellError as error:
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=str(error))
    assert planned.device
    return replace(told, reason=f"{told.reason}, by the {clock_of(planned.device)} clock") if told.changes else told


def verdict_of(base: Judged, ratio: Ratio | None, tolerance: Tolerance) -> Judged:
    """Return `base` with the verdict that a ratio of times, now over then, allows.

    It is regressed only where the whole interval of the ratio is above what the tolerance allows, and improved only
    where the whole interval is below 1 by as much. A ratio of too few rounds, or that is no number, is incomparable.
    """
    if ratio is None or not ratio.proved:
        rounds = ratio.pairs if ratio else 0
        reason = f"{plural(rounds, 'round')} {'proves' if rounds == 1 else 'prove'} nothing; raise [budget] seconds"
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=reason)
    allowed = tolerance.allowed(1.0)
    slack = allowed - 1.0
    if not all(map(math.isfinite, (ratio.lower, ratio.upper))):
        return replace(base, verdict=Verdict.INCOMPARABLE, reason="the times' ratio is no number")
    kept, better = ratio.lower <= allowed, ratio.upper < 1.0 - slack
    verdict = Verdict.IMPROVED if better else Verdict.PASS if kept else Verdict.REGRESSED
    told = f"{TOLD}{ratio.lower:.3f} to {ratio.upper:.3f} (95 %, {plural(ratio.pairs, 'round')})"
    change = Change(SPEED.name, 1.0, ratio.median, allowed, verdict, tolerance)
    return replace(base, verdict=verdict, reason=told, changes=(change,))


def clock_of(device: DeviceInfo) -> Clock:
    """Name the clock by which frames of a device are compared."""
    return device.clock if device.resident else "processor"  # a device that holds items in its units is a GPU


def _told(timing: Timing, clock: Clock) -> float:
    """Read a frame's time by a clock, in ms. Raises CellError where the clock tells none.

    A time by another clock could not be paired with the others.
    """
    told = {"device": timing.device_ms, "wall": timing.wall_ms, "processor": timing.processor_ms}[clock]
    if not told or not math.isfinite(told):
        raise CellError(CellStatus.FAILED, f"the {clock} clock told {told} for a frame")
    return told


def _is_enough(ratio: Ratio, tolerance: Tolerance) -> bool:
    """Tell whether a ratio's interval is narrow, or lies on one side of what is allowed."""
    allowed = tolerance.allowed(1.0)
    return ratio.proved and (_is_narrow(ratio, tolerance) or ratio.lower > allowed or ratio.upper <= allowed)


def _is_narrow(ratio: Ratio, tolerance: Tolerance) -> bool:
    return ratio.proved and ratio.upper - ratio.lower <= NARROW * (tolerance.allowed(1.0) - 1.0) * ratio.median


def _ratio(
    planned: Planned, sides: Sides, experiment: Experiment, tolerance: Tolerance, executor: Executor
) -> Ratio | None:
    """Time both programs once in each round, in random order, and return the ratio of their times, now over then.

    Rounds go on until the ratio's interval is narrow or the budget is spent. If the interval then does not tell whether
    the ratio is allowed, the budget is doubled, up to LONGEST times. Raises CellError where a frame fails or the clock
    tells no time.
    """
    budget = experiment.config.budget
    assert planned.device
    frames = {side: frame for side, casting in sides.items() if (frame := casting.frame())}
    device, keys = planned.cell.device, {side: f"{planned.key} {side}" for side in sides}
    clock = clock_of(planned.device)
    batch = max(executor.warm(device, keys[side], frame).batch for side, frame in frames.items())
    times: dict[str, list[float]] = {side: [] for side in sides}
    start, more, ratio = time.perf_counter(), 1, None
    for round_number in itertools.count():
        for side in shuffled(list(sides), experiment.config.seed, round_number):
            times[side].append(_told(executor.sample(device, keys[side], frames[side], batch), clock))
        rounds = range(round_number + 1)
        ratio = timings.paired_ratio(times["now"], rounds, times["then"], rounds)
        assert ratio
        spent = time.perf_counter() - start >= 2.0 * more * budget.seconds or len(rounds) >= more * budget.repetitions
        if len(rounds) < MINIMUM_ROUNDS or not (spent or _is_narrow(ratio, tolerance)):
            continue
        if _is_enough(ratio, tolerance) or more >= LONGEST:
            break
        more *= 2
    for side in sides:
        executor.release(device, keys[side])
    return ratio
