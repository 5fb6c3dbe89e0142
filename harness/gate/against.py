"""Speed against another revision: both programs' frames in interleaved rounds of one run on one device."""

from __future__ import annotations

import itertools
import math
import time
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import answers, freeloops, judge
from harness.accuracy import pixels as beams
from harness.contract import CellStatus, Hits, Program
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.worker import Frame
from harness.experiment.config import Experiment
from harness.experiment.plan import Planned, shuffled
from harness.gate.entries import slot_of
from harness.gate.judge import Change, Judged, Tolerance, Verdict
from harness.gate.revision import Former
from harness.kernels.assemble import with_free_loops
from harness.oracle import cached_first_hits
from harness.results import timings
from harness.results.figures import SPEED
from harness.results.timings import Ratio
from harness.scenes.camera import rays_of, scene_radius

MINIMUM_ROUNDS = 10
SIDES = ("now", "then")


def compare(
    planned: list[Planned],
    former: dict[str, Former],
    experiment: Experiment,
    tolerance: Tolerance,
    executor: LocalExecutor,
    truth: Path,
) -> list[Judged]:
    """A verdict for each timed cell that answers rightly enough at both revisions; the ratio is now over then."""
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
    if planned.draws:
        return replace(base, verdict=Verdict.INCOMPARABLE, reason="stage raster's pictures are not raced")
    if planned.prepass:
        return replace(base, verdict=Verdict.INCOMPARABLE, reason="rays behind a prepass are not raced")
    if former is None:
        return replace(base, verdict=Verdict.NEW, reason="the other revision has no such cell")
    if former.timed is None:
        return replace(base, verdict=Verdict.NEW, reason=f"the other revision skips it: {former.skip}")
    assert planned.timed
    if (former.timed.language, former.timed.precision) != (planned.timed.language, planned.timed.precision):
        return replace(base, verdict=Verdict.INCOMPARABLE, reason="the other revision's program is in another language")
    if former.timed.hash == planned.timed.hash:
        return replace(base, reason="the same program")
    try:
        if reason := _wrong(planned, former, experiment, executor, truth):
            return replace(base, verdict=Verdict.INCOMPARABLE, reason=reason)
        ratio = _race(planned, former, experiment, tolerance, executor)
    except CellError as error:
        return replace(base, verdict=Verdict.INCOMPARABLE, reason=str(error))
    return verdict_of(base, ratio, tolerance)


def verdict_of(base: Judged, ratio: Ratio | None, tolerance: Tolerance) -> Judged:
    """Regressed only where the whole interval of the ratio is above what is allowed."""
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


def _wrong(
    planned: Planned, former: Former, experiment: Experiment, executor: LocalExecutor, truth: Path
) -> str | None:
    """Nothing is timed before its hits are held against the oracle; why this is not timed, if so."""
    surface, choice = planned.cell.surface, experiment.config.accuracy
    rays = rays_of(planned.camera, choice.size)
    certified = cached_first_hits(surface, rays, truth)
    frame = planned.frame
    assert frame and former.timed
    present = _Side(planned.checks[0] if planned.checks else None, frame)
    other = _Side(former.check, replace(frame, program=former.timed))
    if reason := judge.undecided_too_many(certified, choice.undecided):
        return reason
    for side, when in ((present, "now"), (other, "at the other revision")):
        hits = _hits(side, planned, rays, choice.size, executor)
        if side.check:
            free = replace(side, check=with_free_loops(side.check))
            cast_freely = partial(_hits, free, planned, rays, choice.size, executor)
            if reason := freeloops.removed((side.check,), hits, cast_freely):
                return f"{reason} {when}"
        precision = planned.cell.precision
        verdicts = judge.judge(hits, certified, scene_radius(surface), choice.grazing_margin, precision)
        judged = judge.judged(certified, verdicts)
        if not judged.any():
            return judge.nothing_judged(len(rays))
        share = np.mean(verdicts.wrong[judged] != judge.Wrong.RIGHT)
        if not share <= choice.max_wrong_share:
            return f"wrong on {share:.1%} of the rays that are neither grazing nor drowned {when}: not timed"
    return None


@dataclass(frozen=True, eq=False)
class _Side:
    """One revision's programs: the one that is checked, if it is not the frame's, and the frame's."""

    check: Program | None
    frame: Frame


def _hits(side: _Side, planned: Planned, rays: NDArray[np.float32], size: int, executor: LocalExecutor) -> Hits:
    device, domain = planned.cell.device, planned.cell.surface.domain
    if planned.casts == "rays" and side.check:
        checked = executor.check(device, side.check, rays)
        return answers.validated(checked.hits, domain, rays, origin=planned.cell.origin)
    frame = replace(side.frame, program=side.check or side.frame.program)
    pixels = beams.pixels_of(planned.camera, size, frame.size)
    along = beams.along_rays(executor.check_frame(device, frame, pixels.index).hits, pixels)
    return answers.validated_beams(along, domain, rays, planned.camera[3:6])


def _race(
    planned: Planned, former: Former, experiment: Experiment, tolerance: Tolerance, executor: LocalExecutor
) -> Ratio | None:
    """Rounds that time both programs once, in random order, until the interval is narrow or the budget is spent."""
    frame, budget = planned.frame, experiment.config.budget
    assert frame and planned.device and former.timed
    frames = dict(zip(SIDES, (frame, replace(frame, program=former.timed)), strict=True))
    device, keys = planned.cell.device, {side: f"{planned.key} {side}" for side in SIDES}
    batches = {side: executor.warm(device, keys[side], frames[side]).batch for side in SIDES}
    batch = max(batches.values())
    times: dict[str, list[float]] = {side: [] for side in SIDES}
    start, ratio = time.perf_counter(), None
    for round_number in itertools.count():
        for side in shuffled(list(SIDES), experiment.config.seed, round_number):
            timing = executor.sample(device, keys[side], frames[side], batch)
            told = timing.device_ms if planned.device.clock == "device" else timing.wall_ms
            if not told or not math.isfinite(told):  # another clock's time would be no pair to the others
                raise CellError(CellStatus.FAILED, f"the {planned.device.clock}'s clock told {told} for a frame")
            times[side].append(told)
        rounds = range(round_number + 1)
        ratio = timings.paired_ratio(times["now"], rounds, times["then"], rounds)
        assert ratio
        narrow = ratio.proved and ratio.upper - ratio.lower <= tolerance.relative * ratio.median / 2.0
        spent = time.perf_counter() - start >= 2.0 * budget.seconds
        if len(rounds) >= MINIMUM_ROUNDS and (narrow or spent or len(rounds) >= budget.repetitions):
            break
    for side in SIDES:
        executor.release(device, keys[side])
    return ratio
