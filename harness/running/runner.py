"""Run what a plan names: check each cell against the oracle, time cells in interleaved rounds, and store their rows.

A row is stored as soon as its cell ends, and only the runner writes rows. A cell that fails, hangs or takes its driver
down costs its own row. Where the runner itself is stopped, only cells that were not finished are lost.
"""

from __future__ import annotations

import itertools
import time
import uuid
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from harness.contract import CellStatus, FirsthitError
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.messages import Frame, Warmed
from harness.experiment.config import Config
from harness.experiment.kinds import Outcome
from harness.experiment.plan import Planned, shuffled
from harness.plugins import Catalog
from harness.results import timings
from harness.results.store import Row, Store
from harness.results.stored import Stored
from harness.running.rows import Left, Samples, build_of, row_of, time_of

MINIMUM_SAMPLES = 8
LONGEST = 16  # times [budget] seconds: the longest that a cell is timed to get the rounds that comparing it needs
BYTES_PER_RAY = 24  # at most, of a frame that is kept ready: its answer on the device, and the copy that was read back
MOST_BYTES = 3 * 2**30  # of all frames that are kept ready at once
UNCHECKED = Outcome(0.0)


@dataclass(eq=False)
class _Live:
    """Hold the state of a cell that is being run."""

    planned: Planned
    frame: Frame | None
    samples: Samples
    outcome: Outcome = UNCHECKED
    warmed: Warmed | None = None
    preparing: float = 0.0  # seconds of checking and building
    timing: float = 0.0  # seconds of timed repetitions


class Runner:
    """Run cells and store their rows.

    `report` is called with a cell's slot and None when the cell is worked on, and with its slot and row when the row is
    stored. `built` is called with a cell's slot and a line for each program that was built for it, with what the
    compiler said. `environment` is stored in every row.
    """

    def __init__(
        self,
        config: Config,
        catalog: Catalog,
        store: Store,
        executor: LocalExecutor,
        environment: dict[str, Any],
        report: Callable[[str, Row | None], None],
        built: Callable[[str, str], None] | None = None,
    ) -> None:
        self._config, self._catalog, self._store = config, catalog, store
        self._executor, self._environment, self._report = executor, environment, report
        self._built, self._session = built, ""

    def run(self, planned: Iterable[Planned]) -> Stored:
        """Run cells and return their rows, in the order in which they ended; each is read when it is asked for.

        Cells that are to be compared with each other are timed in the same interleaved rounds. A cell that fails is a
        row; raises FirsthitError where a row cannot be stored.
        """
        groups: dict[str, list[Planned]] = {}
        for one in planned:
            groups.setdefault(one.cell.together, []).append(one)
        ended = Stored(self._store)
        for part in (part for group in groups.values() for part in _fitting(group)):
            for row in self._compare(part):
                ended.add(row)
        return ended

    def _compare(self, group: list[Planned]) -> list[Row]:
        """Check every cell of a group, and then time those together that are to be timed."""
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
        """Check the cell and, if it is to be timed, warm its frame. Return why it failed; None where it did not."""
        planned, start = state.planned, time.perf_counter()
        assert planned.casting
        try:
            framed = state.frame is not None
            state.outcome = planned.casting.check(self._executor, self._config.accuracy, self._store.truth, framed)
            if state.outcome.reason is None and state.frame and planned.is_timed:
                state.warmed = self._executor.warm(planned.cell.device, planned.key, state.frame)
            return state.outcome.reason
        finally:
            state.preparing = time.perf_counter() - start
            if self._built:
                for line in self._executor.builds(planned.cell.device):
                    self._built(planned.cell.slot, line)

    def _time(self, live: dict[str, _Live]) -> list[Row]:
        """Time cells in interleaved rounds, each of which visits every unfinished cell once, in random order.

        Returns their rows. A cell whose frame fails gets a row too.
        """
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
        """Take one sample of a cell's time."""
        assert state.warmed and state.frame
        start = time.perf_counter()
        batch = state.warmed.batch
        timing = self._executor.sample(state.planned.cell.device, state.planned.key, state.frame, batch)
        state.samples.add(timing, batch, round_number)
        state.timing += time.perf_counter() - start

    def _is_done(self, state: _Live) -> bool:
        """Tell whether a cell has enough samples, or has spent its budget."""
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
        self._store.write(row, state.outcome.pictures if state else None)
        self._report(planned.cell.slot, row)
        return row

    def _left(self, state: _Live, status: CellStatus) -> Left:
        """Return what the cell left behind; times only where it ended well."""
        timed = None
        if state.warmed and status is CellStatus.OK:
            seed, interval = self._config.seed, self._config.budget.interval
            timed = time_of(state.samples, state.warmed.batch, self._session, seed=seed, interval=interval)
        build = build_of(state.warmed, state.outcome.compile_ms)
        return Left(build, state.preparing + state.timing, timed, state.outcome.summary, state.outcome.rungs)


def _fitting(group: list[Planned]) -> list[list[Planned]]:
    """Split a group by comparison where its frames are too large to be kept ready at once; else keep it whole."""
    rays = sum(p.cell.size**2 * p.cell.samples_per_pixel for p in group if p.timed)
    if rays * BYTES_PER_RAY <= MOST_BYTES:
        return [group]
    return [list(part) for _, part in itertools.groupby(group, key=lambda p: p.cell.comparison)]
