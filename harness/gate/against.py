"""Compare speed with another revision: both programs draw frames in interleaved rounds of one run on one device."""

from __future__ import annotations

import itertools
import math
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from harness.contract import CellStatus
from harness.devices.executor import CellError, LocalExecutor
from harness.experiment import plan
from harness.experiment.config import Experiment
from harness.experiment.kinds.model import RacedCasting
from harness.experiment.plan import Planned, shuffled
from harness.gate.checked import Checked
from harness.gate.entries import slot_of
from harness.gate.judge import Change, Judged, Tolerance, Verdict
from harness.gate.revision import Former, programs_at
from harness.results import timings
from harness.results.figures import SPEED
from harness.results.timings import Ratio
from harness.running.environment import probed

MINIMUM_ROUNDS = 10
WHEN = {"now": "now", "then": "at the other revision"}
Sides = Mapping[str, RacedCasting]


def speeds(checked: Checked, revision: str, config: Path, plugins: Path | None) -> list[Judged]:
    """Judge each timed cell's speed against its program at another git revision.

    Times are by the clock that the device's probes support. `config` and `plugins` are the files that `checked` is of.
    Raises FirsthitError where there is no such revision or its code cannot plan the config.
    """
    experiment = checked.experiment
    here = {p.cell.device: p.device for p in checked.planned if p.device}
    own = experiment.config.gate.figures.get(SPEED.name)
    tolerance = Tolerance("lower", own.absolute, own.relative) if own else Tolerance("lower", 0.0, SPEED.relative)
    former = programs_at(revision, config, plugins, list(here))
    executor = LocalExecutor(experiment.config.budget.timeout)
    try:
        infos = [probed(executor, info, checked.folder / "probes")[0] for info in here.values()]
        wanted = {slot_of(p) for p in checked.planned}
        planned = plan.plan(experiment, checked.catalog, infos)
        answering = [p for p in planned if p.skip is None and slot_of(p) in wanted]
        return compare(answering, former, experiment, tolerance, executor, checked.folder / "truth")
    finally:
        executor.close()


def compare(
    planned: list[Planned],
    former: dict[str, Former],
    experiment: Experiment,
    tolerance: Tolerance,
    executor: LocalExecutor,
    truth: Path,
) -> list[Judged]:
    """Judge each timed cell by the time of its frame now, over the time of its frame at the other revision.

    `former` holds the other revision's programs by the cell's slot. A cell is incomparable where its answers at either
    revision fail the check against the oracle, whose certified answers are kept in the folder `truth`. A failure while
    running is a verdict too, and raises nothing.
    """
    return [_judged(p, former.get(p.cell.slot), experiment, tolerance, executor, truth) for p in planned if p.timed]


def _judged(
    planned: Planned,
    former: Former | None,
    experiment: Experiment,
    tolerance: Tolerance,
    executor: LocalExecutor,
    truth: Path,
) -> Judged:
    base = Judged(f"{slot_of(planned)}: speed", planned.cell.device, planned.cell.variant.method, Verdict.PASS)
    casting = planned.casting
    if not isinstance(casting, RacedCasting):
        reason = casting.not_raced if casting else planned.skip
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=reason or "it is cast from no view")
    if former is None:
        return replace(base, verdict=Verdict.NEW, reason="the other revision has no such cell")
    if former.timed is None:
        return replace(base, verdict=Verdict.NEW, reason=f"the other revision skips it: {former.skip}")
    assert planned.timed
    if (former.timed.language, former.timed.precision) != (planned.timed.language, planned.timed.precision):
        return replace(base, verdict=Verdict.INCOMPARABLE, reason="the other revision's program is in another language")
    if former.timed.hash == planned.timed.hash:
        return replace(base, reason="the same program")
    sides = {"now": casting, "then": casting.with_programs(former.check, former.timed)}
    try:
        if wrong := _wrong(sides, experiment, executor, truth):
            return replace(base, verdict=Verdict.INCOMPARABLE, reason=wrong)
        ratio = _race(planned, sides, experiment, tolerance, executor)
    except CellError as error:
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=str(error))
    return verdict_of(base, ratio, tolerance)


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


def _wrong(sides: Sides, experiment: Experiment, executor: LocalExecutor, truth: Path) -> str | None:
    """Say why the two programs must not be timed, or return None where both answer as the oracle does."""
    for side, casting in sides.items():
        if reason := casting.check(executor, experiment.config.accuracy, truth, framed=True).reason:
            return f"{reason} ({WHEN[side]})"
    return None


def _race(
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
        narrow = ratio.proved and ratio.upper - ratio.lower <= tolerance.relative * ratio.median / 2.0
        spent = time.perf_counter() - start >= 2.0 * budget.seconds
        if len(rounds) >= MINIMUM_ROUNDS and (narrow or spent or len(rounds) >= budget.repetitions):
            break
    for side in sides:
        executor.release(device, keys[side])
    return ratio
