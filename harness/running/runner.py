"""Runs what a plan names: check against the oracle, then time in interleaved rounds, and store each row as it ends.

One writer. A cell that fails, hangs or takes its driver down costs its own row; whatever stops the runner itself loses
only cells that were not finished.
"""

from __future__ import annotations

import itertools
import math
import time
import uuid
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import answers, check_frames, compilers, freeloops, judge
from harness.accuracy import pixels as beams
from harness.accuracy.pictures import headlight, pictures_of
from harness.accuracy.rungs import judge_group
from harness.contract import CellStatus, FirsthitError, Hits, Program
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.worker import Checked, Frame, Warmed
from harness.experiment.config import Config
from harness.experiment.plan import Planned, shuffled
from harness.hardcases import groups as stability
from harness.kernels.assemble import method_program, with_free_loops
from harness.oracle import cached_first_hits
from harness.plugins import Catalog
from harness.results import timings
from harness.results.store import Row, Store
from harness.running.rows import Left, Samples, build_of, row_of, time_of
from harness.scenes.camera import meets, pixel_footprint, rays_of, scene_radius

MINIMUM_SAMPLES = 8
LONGEST = 16  # times [budget] seconds: what the rounds that comparing a cell takes may take at most
BYTES_PER_RAY = 24  # of a frame kept ready, at most: its answer on the device, and as it was read back
MOST_BYTES = 3 * 2**30  # of all frames kept ready at once
UNFINISHED = (CellStatus.FAILED, CellStatus.TIMEOUT, CellStatus.CRASHED)


@dataclass(eq=False)
class _Live:
    """A cell on its way from plan to row."""

    planned: Planned
    frame: Frame | None
    samples: Samples
    compile_ms: float = 0.0
    warmed: Warmed | None = None
    preparing: float = 0.0  # seconds of checking and building
    timing: float = 0.0  # seconds of timed repetitions
    summary: dict[str, Any] | None = None
    rungs: list[dict[str, Any]] | None = None
    arrays: dict[str, NDArray[Any]] | None = None


class Runner:
    """`report(row, index)` is called after each stored row."""

    def __init__(
        self,
        config: Config,
        catalog: Catalog,
        store: Store,
        executor: LocalExecutor,
        environment: dict[str, Any],
        report: Callable[[str, Row | None], None],
    ) -> None:
        self._config, self._catalog, self._store = config, catalog, store
        self._executor, self._environment, self._report = executor, environment, report
        self._session = ""

    def run(self, planned: Iterable[Planned]) -> list[Row]:
        """Run cells, those that are timed together after each other; the rows, in the order in which they ended."""
        groups: dict[str, list[Planned]] = {}
        for one in planned:
            groups.setdefault(one.cell.together, []).append(one)
        return [row for group in groups.values() for part in _fitting(group) for row in self._compare(part)]

    def _compare(self, group: list[Planned]) -> list[Row]:
        rows: list[Row] = []
        live: dict[str, _Live] = {}
        for planned in group:
            self._report(planned.cell.slot, None)
            if planned.skip is not None:
                rows.append(self._finish(planned, None, CellStatus.SKIPPED, planned.skip))
                continue
            state = None
            try:
                assert planned.device
                state = _Live(planned, planned.frame, Samples(planned.device.clock))
                reason = self._prepare(state)
            except (CellError, FirsthitError) as error:  # a mesh that cannot be made costs its own rows
                status = error.status if isinstance(error, CellError) else CellStatus.FAILED
                rows.append(self._finish(planned, state, status, str(error)))
                continue
            if reason is not None:
                rows.append(self._finish(planned, state, CellStatus.FAILED, reason))
            elif state.warmed is None:
                rows.append(self._finish(planned, state, CellStatus.OK, None))
            else:
                live[planned.key] = state
        rows += self._time(live)
        return rows

    def _prepare(self, state: _Live) -> str | None:
        """Check the cell and, if it is to be timed, warm its frame; a reason not to time it, if there is one."""
        start = time.perf_counter()
        try:
            reason = self._check_family(state) if state.planned.cell.family else self._check(state)
            if reason is None and state.frame and state.planned.is_timed:
                state.warmed = self._executor.warm(state.planned.cell.device, state.planned.key, state.frame)
            return reason
        finally:
            state.preparing = time.perf_counter() - start

    def _check(self, state: _Live) -> str | None:
        """Cast the accuracy rays and hold them against the oracle; a reason not to time the cell, if there is one."""
        cell, config = state.planned.cell, self._config.accuracy
        if state.planned.draws:
            seen = check_frames.check(self._executor, state.planned, config, self._store.truth)
            state.summary, state.arrays, state.compile_ms = seen.summary, seen.pictures, seen.compile_ms
            return seen.fault or self._unfit(state)
        rays = rays_of(state.planned.camera, config.size)
        truth = cached_first_hits(cell.surface, rays, self._store.truth)
        casts_beams, checks = state.planned.casts != "rays", state.planned.checks
        checked, hits = self._cast(state, rays, checks[0])
        state.compile_ms = checked.compile_ms
        verdicts = judge.judge(hits, truth, scene_radius(cell.surface), config.grazing_margin, cell.precision)
        if casts_beams:
            assert state.frame
            pixels = beams.pixels_of(state.planned.camera, config.size, state.frame.size)
            verdicts, beam_only = beams.set_apart(verdicts, hits, truth, pixels)
        footprint = pixel_footprint(state.planned.camera, cell.size)
        deviations = judge.deviations(cell.surface, rays, hits, truth, verdicts)
        summary = judge.summarize(
            cell.surface,
            hits,
            truth,
            verdicts,
            deviations,
            precision=cell.precision,
            footprint=footprint,
            grazing_margin=config.grazing_margin,
        )
        inside = int(meets(cell.surface.domain, rays).sum())
        state.summary = {"size": config.size, "domain_rays": inside} | summary
        if checked.prepass_evaluations is not None:
            state.summary["prepass_evaluations_mean"] = checked.prepass_evaluations
        state.arrays = pictures_of(cell.surface, rays, hits, truth, verdicts, config.size)
        if casts_beams:
            assert checked.evaluations is not None and checked.levels is not None
            mean, largest = checked.evaluations  # of the frame: large beams are shared by more pixels than are checked
            counted = {"beam_only": int(beam_only.sum()), "evaluations_mean": mean, "evaluations_max": largest}
            state.summary |= counted | {"lanes": checked.lanes}
            state.arrays["level"] = checked.levels.reshape(config.size, config.size)
        fault = freeloops.removed(checks, hits, lambda: self._cast(state, rays, with_free_loops(checks[0]))[0].hits)
        if not fault and not casts_beams:
            fault = self._compilers_fault(state, rays, hits)
        if cell.samples_per_pixel > 1:
            side = config.size * round(cell.samples_per_pixel**0.5)
            samples = rays_of(state.planned.camera, side)
            shade = headlight(cell.surface, samples, self._cast(state, samples, checks[0])[1])
            state.arrays["samples"] = shade.reshape(side, side)
        return fault or self._unfit(state)

    def _cast(self, state: _Live, rays: NDArray[np.float32], program: Program) -> tuple[Checked, Hits]:
        """What `program` answers for `rays`, float32[n², 6], a grid of the cell's view, and that as valid hits."""
        cell, camera = state.planned.cell, state.planned.camera
        casts_beams = state.planned.casts != "rays"
        if not casts_beams and cell.prepass == "none":
            checked = self._executor.check(cell.device, program, rays)
            return checked, answers.validated(checked.hits, cell.surface.domain, rays, origin=cell.origin)
        assert state.frame
        pixels = beams.pixels_of(camera, math.isqrt(len(rays)), state.frame.size)
        frame = replace(state.frame, program=program, rays=rays)
        checked = self._executor.check_frame(cell.device, frame, pixels.index)
        if casts_beams:
            along = beams.along_rays(checked.hits, pixels)
            return checked, answers.validated_beams(along, cell.surface.domain, rays, camera[3:6])
        hits = answers.validated(checked.hits, cell.surface.domain, rays, counts=False, origin=cell.origin)
        return checked, hits

    def _compilers_fault(self, state: _Live, rays: NDArray[np.float32], hits: Hits) -> str | None:
        cell, plugin = state.planned.cell, self._catalog.get(state.planned.cell.variant.method)
        if not plugin.method.answers:
            return None
        program = partial(method_program, plugin.method, plugin.folder, cell.variant, cell.surface, cell.precision)
        run = compilers.with_listed_rays(self._executor, rays)
        second = compilers.SecondBuild(
            cell.device, cell.precision, partial(program, entry="rays", origin=cell.origin), run
        )
        return compilers.doubts_about(cell.surface, rays, hits, second).fault

    def _unfit(self, state: _Live) -> str | None:
        """Why a checked cell has no accuracy, which it then loses, or is too wrong to be timed."""
        assert state.summary is not None
        if not self._catalog.get(state.planned.cell.variant.method).method.answers:
            return None
        found, config = state.summary, self._config.accuracy
        share = judge.wrong_share(found)
        undecided = judge.undecided_hits(found["truth_hits"], found["undecided"], config.undecided)
        if undecided or share is None:
            state.summary = state.arrays = None
            return undecided or judge.nothing_judged(found["rays"])
        if state.frame and not share <= config.max_wrong_share:
            return f"wrong on {share:.1%} of the rays that are neither grazing nor drowned: not timed"
        return None

    def _check_family(self, state: _Live) -> str | None:
        """Cast every rung's rays and judge each rung by itself."""
        cell = state.planned.cell
        assert cell.family
        state.rungs = []
        for group, program in zip(stability.groups(cell.family), state.planned.checks, strict=True):
            truth = cached_first_hits(group.surface, group.rays, self._store.truth)
            checked = self._executor.check(cell.device, program, group.rays)
            hits = answers.validated(checked.hits, group.surface.domain, group.rays, origin=cell.origin)
            state.compile_ms += checked.compile_ms
            state.rungs += judge_group(group, hits, truth, cell.precision)
        rays, undecided = (sum(rung[name] for rung in state.rungs) for name in ("rays", "undecided"))
        reason = judge.undecided_hits(rays - undecided, undecided, self._config.accuracy.undecided, "rays")
        if reason:
            state.rungs = None
        return reason

    def _time(self, live: dict[str, _Live]) -> list[Row]:
        """Interleaved rounds: each visits every unfinished cell once, in random order."""
        rows: list[Row] = []
        self._session = uuid.uuid4().hex[:16]
        for round_number in itertools.count():
            if not live:
                return rows
            for key in shuffled(list(live), self._config.seed, round_number):
                state = live[key]
                self._report(state.planned.cell.slot, None)
                try:
                    self._sample(state, round_number)
                    if self._is_done(state):
                        rows.append(self._finish(state.planned, state, CellStatus.OK, None))
                        del live[key]
                        self._executor.release(state.planned.cell.device, key)
                except CellError as error:
                    if key in live:
                        rows.append(self._finish(state.planned, state, error.status, str(error)))
                        del live[key]
        raise AssertionError("unreachable")

    def _sample(self, state: _Live, round_number: int) -> None:
        assert state.warmed and state.frame
        start = time.perf_counter()
        batch = state.warmed.batch
        timing = self._executor.sample(state.planned.cell.device, state.planned.key, state.frame, batch)
        state.samples.add(timing, batch, round_number)
        state.timing += time.perf_counter() - start

    def _is_done(self, state: _Live) -> bool:
        budget, count = self._config.budget, len(state.samples.wall_ms)
        comparable = count >= budget.rounds
        narrow = comparable and count >= MINIMUM_SAMPLES and timings.is_narrow(state.samples.times, budget.interval)
        spent = state.timing >= (budget.seconds if comparable else LONGEST * budget.seconds)
        return narrow or spent or count >= budget.repetitions

    def _finish(self, planned: Planned, state: _Live | None, status: CellStatus, reason: str | None) -> Row:
        """Build the row of a cell that ended, store it, and report it."""
        method = self._catalog.get(planned.cell.variant.method).method
        left = self._left(state, status) if state else None
        row: Row = dict(row_of(planned, method, status, reason, left, self._environment))
        self._store.write(row, state.arrays if state else None)
        self._report(planned.cell.slot, row)
        return row

    def _left(self, state: _Live, status: CellStatus) -> Left:
        timed = None
        if state.warmed and status is CellStatus.OK:
            seed, interval = self._config.seed, self._config.budget.interval
            timed = time_of(state.samples, state.warmed.batch, self._session, seed=seed, interval=interval)
        build = build_of(state.warmed, state.compile_ms)
        return Left(build, state.preparing + state.timing, timed, state.summary, state.rungs)


def _fitting(group: list[Planned]) -> list[list[Planned]]:
    """The group whole where its frames are small enough to be kept ready at once, else comparison by comparison."""
    rays = sum(p.cell.size**2 * p.cell.samples_per_pixel for p in group if p.timed)
    if rays * BYTES_PER_RAY <= MOST_BYTES:
        return [group]
    return [list(part) for _, part in itertools.groupby(group, key=lambda p: p.cell.comparison)]
