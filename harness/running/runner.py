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
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import answers, check_frames, compilers, freeloops, judge
from harness.accuracy import pixels as beams
from harness.accuracy.pictures import headlight, pictures_of
from harness.accuracy.rungs import judge_group
from harness.contract import CellStatus, FirsthitError, Hits, Program, Surface, View
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.worker import Checked, Frame, Warmed
from harness.experiment.config import Config
from harness.experiment.plan import Planned, shuffled
from harness.hardcases import groups as stability
from harness.kernels.assemble import method_program, with_free_loops
from harness.kernels.costs import operations_per_evaluation
from harness.oracle import cached_first_hits
from harness.plugins import Catalog
from harness.results import timings
from harness.results.store import Row, Store
from harness.scenes.camera import distance_of, meets, pixel_footprint, rays_of, scene_radius

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
    compile_ms: float = 0.0
    warmed: Warmed | None = None
    wall_ms: list[float] = field(default_factory=list)
    device_ms: list[float] = field(default_factory=list)
    rounds: list[int] = field(default_factory=list)  # the round of each sample, so that cells of one run can be paired
    preparing: float = 0.0  # seconds of checking and building
    timing: float = 0.0  # seconds of timed repetitions
    summary: dict[str, Any] | None = None
    rungs: list[dict[str, Any]] | None = None
    arrays: dict[str, NDArray[Any]] | None = None

    @property
    def by_device(self) -> bool:
        """Whether times are by the device's own clock: where that is believed and told every sample's."""
        assert self.planned.device
        return self.planned.device.clock == "device" and len(self.device_ms) == len(self.wall_ms)

    @property
    def samples(self) -> list[float]:
        return self.device_ms if self.by_device else self.wall_ms


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
                state = _Live(planned, planned.frame)
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
        state.wall_ms.append(timing.wall_ms / batch)
        if timing.device_ms is not None:
            state.device_ms.append(timing.device_ms / batch)
        state.rounds.append(round_number)
        state.timing += time.perf_counter() - start

    def _is_done(self, state: _Live) -> bool:
        budget, count = self._config.budget, len(state.wall_ms)
        comparable = count >= budget.rounds
        narrow = comparable and count >= MINIMUM_SAMPLES and timings.is_narrow(state.samples, budget.interval)
        spent = state.timing >= (budget.seconds if comparable else LONGEST * budget.seconds)
        return narrow or spent or count >= budget.repetitions

    def _finish(self, planned: Planned, state: _Live | None, status: CellStatus, reason: str | None) -> Row:
        cell, method = planned.cell, self._catalog.get(planned.cell.variant.method).method
        programs = ((planned.timed,) if planned.timed else ()) + planned.checks
        row: Row = {
            "key": planned.key,
            "slot": cell.slot,
            "comparison": cell.comparison,
            "method": cell.variant.method,
            "variant": cell.caster,
            "parameters": dict(cell.variant.parameters),
            "surface": cell.surface.name,
            "surface_title": cell.surface.title,
            "formula": cell.surface.formula,
            "degree": cell.surface.degree,
            "view": cell.view.name,
            "view_set": cell.view.set,
            "camera": None if cell.family else _pose(cell.view, cell.surface),
            "size": cell.size,
            "samples_per_pixel": cell.samples_per_pixel,
            "precision": cell.precision,
            "stage": cell.stage,
            "device": cell.device,
            "answers": method.answers,
            "casts": method.casts,
            "prepass": cell.prepass,
            "origin": cell.origin if method.casts == "rays" else None,
            "proxy": cell.proxy if cell.stage == "raster" else None,
            "normal": cell.normal if cell.stage == "raster" else None,
            "pixel_tolerance": cell.tolerance if cell.stage == "raster" else None,
            "scene": cell.scene.family if cell.scene else None,
            "instances": cell.scene.instances if cell.scene else None,
            "status": status.value,
            "reason": reason,
            "time": self._time_of(state) if state and state.warmed and status is CellStatus.OK else None,
            "build": _build_of(state) if state else None,
            "accuracy": state.summary if state else None,
            "family": cell.family,
            "rungs": state.rungs if state else None,
            "arrays": None,
            "operations": _operations(cell.surface) if state else None,
            "evaluation_operations": operations_per_evaluation(cell.surface, method.needs) if state else None,
            "program": {"hash": programs[0].hash} if programs else None,
            "environment": self._environment | {"started": datetime.now(UTC).isoformat(timespec="seconds")},
            "seconds": state.preparing + state.timing if state else 0.0,
            "identity": planned.identity,
        }
        self._store.write(row, state.arrays if state else None)
        self._report(cell.slot, row)
        return row

    def _time_of(self, state: _Live) -> dict[str, Any]:
        assert state.warmed and state.planned.device
        median, lower, upper, _ = timings.median_interval(state.samples)
        bootstrap_lower, bootstrap_upper = timings.bootstrap_interval(state.samples, self._config.seed)
        return {
            "clock": "device" if state.by_device else "wall",
            "samples_ms": state.samples,
            "wall_samples_ms": state.wall_ms,
            "rounds": state.rounds,
            "session": self._session,  # cells of one session were interleaved: their rounds pair
            "batch": state.warmed.batch,
            "median_ms": median,
            "lower_ms": lower,
            "upper_ms": upper,
            "bootstrap_lower_ms": bootstrap_lower,
            "bootstrap_upper_ms": bootstrap_upper,
            "narrow": timings.is_narrow(state.samples, self._config.budget.interval),
            "overhead_share": timings.overhead(state.wall_ms, state.device_ms) if state.by_device else None,
            **timings.steadiness(state.samples),
        }


def _fitting(group: list[Planned]) -> list[list[Planned]]:
    """The group whole where its frames are small enough to be kept ready at once, else comparison by comparison."""
    rays = sum(p.cell.size**2 * p.cell.samples_per_pixel for p in group if p.timed)
    if rays * BYTES_PER_RAY <= MOST_BYTES:
        return [group]
    return [list(part) for _, part in itertools.groupby(group, key=lambda p: p.cell.comparison)]


def _pose(view: View, surface: Surface) -> dict[str, float]:
    """Degrees, and the distance from the target in scene units, also where the view leaves it to the surface."""
    distance = distance_of(view, surface)
    return {"azimuth": view.azimuth, "elevation": view.elevation, "fov": view.fov, "distance": distance}


def _build_of(state: _Live) -> dict[str, Any]:
    warmed = state.warmed
    return {
        "compile_ms": warmed.compile_ms if warmed else state.compile_ms,
        "upload_ms": warmed.upload_ms if warmed else None,
        "readback_ms": warmed.readback_ms if warmed else None,
        "bytes": warmed.bytes if warmed else None,
    }


def _operations(surface: Surface) -> dict[str, int]:
    import surfaces

    return dict(surfaces.operations(surface))
