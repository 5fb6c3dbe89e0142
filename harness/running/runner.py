"""Run what a plan names: check each cell against the oracle, time cells in interleaved rounds, and store their rows.

A row is stored as soon as its cell ends, and only the runner writes rows. A cell that fails, hangs or takes its driver
down costs its own row. Where the runner itself is stopped, only the step that ran is lost: what checking a cell found,
and the samples of each round, are kept (harness.results.begun), and the next runner goes on from there. docs/rows.md
says why times of two sittings, before and after a stop, make one row.
"""

from __future__ import annotations

import contextlib
import dataclasses
import itertools
import math
import time
import uuid
from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

from harness.contract import CellStatus, FirsthitError
from harness.devices.executor import CellError
from harness.devices.messages import Frame, Warmed
from harness.devices.steps import Executor
from harness.experiment.config import Config
from harness.experiment.kinds import Outcome
from harness.experiment.plan import Planned, shuffled
from harness.plugins import Catalog
from harness.results import timings
from harness.results.begun import Begun, Kept, Sample, Session
from harness.results.store import Row, Store
from harness.results.stored import Stored
from harness.running.rows import Left, Samples, build_of, row_of, time_of, without_figures

MINIMUM_SAMPLES = 8
LONGEST = 16  # times [budget] seconds: the longest that a cell is timed to get the rounds that comparing it needs
BYTES_PER_RAY = 44  # at most, of a frame that is kept ready: its buffers, and the copy of answers that was read back
LONG_ROUND = 1.0  # seconds after which the samples of a round are kept before it is over
MOST_BYTES = 3 * 2**30  # of all frames that are kept ready at once
UNCHECKED = Outcome(0.0)


@dataclass(eq=False)
class _Live:
    """Hold the state of a cell that is being run."""

    planned: Planned
    frame: Frame | None
    samples: Samples
    outcome: Outcome = UNCHECKED
    arrays: str | None = None  # the file of the outcome's pictures, once they are stored
    warmed: Warmed | None = None
    preparing: float = 0.0  # seconds of checking and building
    timing: float = 0.0  # seconds of timed repetitions


class Runner:
    """Run cells and store their rows.

    `report` is called with a cell's slot and None when the cell is worked on, and with its slot and row when the row is
    stored. `built` is called with a cell's slot and a line for each program that was built for it, with what the
    compiler said. `environment` is stored in every row. Runners that work side by side, each for a device of its own,
    share a folder and what is begun there, and the lock `one_writer`.
    """

    def __init__(
        self,
        config: Config,
        catalog: Catalog,
        store: Store,
        executor: Executor,
        environment: Mapping[str, Any],
        report: Callable[[str, Row | None], None],
        built: Callable[[str, str], None] | None = None,
        one_writer: AbstractContextManager[Any] | None = None,
    ) -> None:
        self._config, self._catalog, self._store = config, catalog, store
        self._executor, self._environment, self._report = executor, environment, report
        self._built = built
        self._one_writer: AbstractContextManager[Any] = one_writer or nullcontext()
        self._begun, self._session = Begun(store.folder), Session(store.folder)
        self._moves = executor.moves

    def run(self, planned: Iterable[Planned], begun: Begun | None = None, ended: Stored | None = None) -> Stored:
        """Run cells and return their rows, in the order in which they ended; each is read when it is asked for.

        Cells that are to be compared with each other are timed in the same interleaved rounds. `begun` is what is kept
        of the cells; without it they begin anew where nothing is kept. Rows are added to those that `ended` before. A
        cell that fails is a row; raises FirsthitError where a row cannot be stored.
        """
        self._begun = begun or Begun(self._store.folder)
        ended = Stored(self._store) if ended is None else ended
        for part in (part for group in together(planned) for part in _fitting(group)):
            rows = self._compare(part)
            with self._one_writer:
                for row in rows:
                    ended.add(row)
        return ended

    def _compare(self, group: list[Planned]) -> list[Row]:
        """Check every cell of a group, and then time those together that are to be timed."""
        rows: list[Row] = []
        live: dict[str, _Live] = {}
        with self._one_writer:
            self._session = self._begun.session([p.key for p in group], uuid.uuid4().hex[:16])
        with contextlib.closing(self._session):
            for planned in group:
                self._tell(planned.cell.slot, None)
                if planned.skip is not None:
                    rows.append(self._finish(planned, None, CellStatus.SKIPPED, planned.skip))
                    continue
                if planned.failure is not None:
                    rows.append(self._finish(planned, None, CellStatus.FAILED, planned.failure))
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
        with self._one_writer:
            self._begun.done(self._session, self._store.has)
        return rows

    def _tell(self, slot: str, row: Row | None) -> None:
        with self._one_writer:
            self._report(slot, row)

    def _prepare(self, state: _Live) -> str | None:
        """Check the cell and, if it is to be timed, warm its frame. Return why it failed; None where it did not."""
        planned, start = state.planned, time.perf_counter()
        assert planned.casting
        try:
            kept = self._session.cells.get(planned.key)
            if kept is None or not self._take_up(state, kept):
                framed = state.frame is not None
                state.outcome = planned.casting.check(self._executor, self._config.accuracy, self._store.truth, framed)
                if state.outcome.reason is None and state.frame and planned.is_timed:
                    self._keep_check(state, time.perf_counter() - start)
            if state.outcome.reason is None and state.frame and planned.is_timed:
                warmed = self._executor.warm(planned.cell.device, planned.key, state.frame)
                if state.warmed is None:
                    state.warmed = warmed
                    self._session.warm(planned.key, dataclasses.asdict(warmed))
            return state.outcome.reason
        finally:
            state.preparing += time.perf_counter() - start
            if self._built:
                lines = self._executor.builds(planned.cell.device)
                with self._one_writer:
                    for line in lines:
                        self._built(planned.cell.slot, line)

    def _keep_check(self, state: _Live, seconds: float) -> None:
        """Keep what checking a cell found, the pictures first. Raises FirsthitError where it cannot be written."""
        outcome, key = state.outcome, state.planned.key
        if outcome.pictures is not None:
            state.arrays = self._store.write_arrays(key, outcome.pictures)
            state.outcome = dataclasses.replace(outcome, pictures=None)  # of many cells they would fill the memory
        facts = {field.name: getattr(state.outcome, field.name) for field in dataclasses.fields(Outcome)}
        with contextlib.suppress(TypeError, ValueError):  # no row can be made of it either, which _finish tells
            self._session.check(key, {"outcome": facts, "arrays": state.arrays, "seconds": seconds})

    def _take_up(self, state: _Live, kept: Kept) -> bool:
        """Take over what is kept of a cell.

        Returns False, and takes over nothing, where its arrays are gone, or where what is kept says something else.
        """
        try:
            outcome, arrays = Outcome(**kept.checked["outcome"]), kept.checked["arrays"]
            warmed, preparing = kept.warmed and Warmed(**kept.warmed), float(kept.checked["seconds"])
            if arrays is not None and not (self._store.folder / arrays).exists():
                return False
        except (KeyError, TypeError, ValueError):
            return False
        state.outcome, state.arrays, state.preparing = outcome, arrays, preparing
        if warmed:
            state.warmed = warmed
            for round_number, (sitting, sample) in kept.samples.items():
                state.samples.add(sample, round_number, sitting)
                state.timing += sample[2]
        return True

    def _time(self, live: dict[str, _Live]) -> list[Row]:
        """Time cells in interleaved rounds, each of which visits every unfinished cell once, in random order.

        Returns their rows. A cell whose frame fails gets a row too. Files are written between rounds only, and within
        one that takes long: a write in between would fall upon one of two samples that are compared.
        """
        self._session.flush()
        rows = [self._end(live, key, None) for key, state in list(live.items()) if self._is_done(state)]
        for round_number in itertools.count(self._session.next_round):
            if not live:
                return rows
            errors = self._round(live, round_number)
            done = {key: None for key, state in live.items() if key not in errors and self._is_done(state)}
            rows += [self._end(live, key, error) for key, error in {**errors, **done}.items()]
        raise AssertionError("unreachable")

    def _round(self, live: dict[str, _Live], round_number: int) -> dict[str, CellError]:
        """Take one sample of each cell and keep it; return what went wrong, by the keys of the cells."""
        errors: dict[str, CellError] = {}
        taken: dict[str, Sample] = {}
        since = time.monotonic()
        self._executor.expect(self._certain(live, round_number))
        try:
            for key in shuffled(list(live), self._config.seed, round_number):
                self._tell(live[key].planned.cell.slot, None)
                try:
                    taken[key] = self._sample(live[key], round_number, taken)
                except CellError as error:
                    errors[key] = error
                if time.monotonic() - since > LONG_ROUND:
                    kept, taken, since = taken, {}, time.monotonic()
                    self._session.round(round_number, kept)
        finally:  # also where Ctrl-C ends it
            self._session.round(round_number, taken)
        return errors

    def _certain(self, live: Mapping[str, _Live], round_number: int) -> list[tuple[str, int]]:
        """List the samples of this round, and of the next few as far as each cell needs them, by key and batch."""
        budget = self._config.budget
        most = max(len(state.samples.wall_ms) for state in live.values())
        rounds = min(MINIMUM_SAMPLES, max(1, min(budget.rounds, budget.repetitions) - most))
        orders = (shuffled(list(live), self._config.seed, round_number + ahead) for ahead in range(rounds))
        return [(key, state.warmed.batch) for key in itertools.chain(*orders) if (state := live[key]).warmed]

    def _end(self, live: dict[str, _Live], key: str, error: CellError | None) -> Row:
        """Store the row of a cell that was timed, and free its frame."""
        state = live.pop(key)
        status, reason = (error.status, str(error)) if error else (CellStatus.OK, None)
        row = self._finish(state.planned, state, status, reason)
        with contextlib.suppress(CellError):  # a worker that fails to free it is started anew for the next step
            self._executor.release(state.planned.cell.device, key)
        return row

    def _sample(self, state: _Live, round_number: int, taken: dict[str, Sample]) -> Sample:
        """Take one sample of a cell's time. Raises CellError where that fails, or the clock tells no time.

        Where another machine or process took it, that is a new sitting, before which those that were `taken` are kept.
        """
        assert state.warmed and state.frame
        batch = state.warmed.batch
        timing = self._executor.sample(state.planned.cell.device, state.planned.key, state.frame, batch)
        if self._executor.moves != self._moves:
            self._moves = self._executor.moves
            self._session.round(round_number, taken)
            taken.clear()
            self._session.sit_again()
        if not 0.0 < timing.wall_ms < math.inf:
            raise CellError(CellStatus.FAILED, f"the clock told {timing.wall_ms:g} ms for a frame")
        told = timing.device_ms if timing.device_ms and 0.0 < timing.device_ms < math.inf else None
        spent = timing.wall_ms / 1e3
        sample = timing.wall_ms / batch, told and told / batch, spent
        state.samples.add(sample, round_number, self._session.sitting)
        state.timing += spent
        return sample

    def _is_done(self, state: _Live) -> bool:
        """Tell whether a cell has enough samples, or has spent its budget."""
        budget, count = self._config.budget, len(state.samples.wall_ms)
        comparable = count >= budget.rounds
        narrow = comparable and count >= MINIMUM_SAMPLES and timings.is_narrow(state.samples.times, budget.interval)
        spent = state.timing >= (budget.seconds if comparable else LONGEST * budget.seconds)
        return count > 0 and (narrow or spent or count >= budget.repetitions)

    def _finish(self, planned: Planned, state: _Live | None, status: CellStatus, reason: str | None) -> Row:
        """Build the row of a cell that ended, store it, and report it.

        A row that holds what cannot be stored, such as a number that is not finite, fails and says so.
        """
        method = self._catalog.get(planned.cell.variant.method).method
        left = self._left(state, status) if state else None
        row: Row = dict(row_of(planned, method, status, reason, left, self._environment))
        pictures = state.outcome.pictures if state else None
        if state and state.arrays:
            row["arrays"] = state.arrays
        with self._one_writer:
            try:
                self._store.write(row, pictures)
            except (TypeError, ValueError) as error:
                row = without_figures(row, str(error))
                self._store.write(row, pictures)
            self._begun.ended(planned.key)
            self._report(planned.cell.slot, row)
        return row

    def _left(self, state: _Live, status: CellStatus) -> Left:
        """Return what the cell left behind; times only where it ended well."""
        timed = None
        if state.warmed and status is CellStatus.OK:
            seed, interval = self._config.seed, self._config.budget.interval
            timed = time_of(state.samples, state.warmed.batch, self._session.name, seed=seed, interval=interval)
        build = build_of(state.warmed, state.outcome.compile_ms)
        return Left(build, state.preparing + state.timing, timed, state.outcome.summary, state.outcome.rungs)


def together(planned: Iterable[Planned]) -> list[list[Planned]]:
    """Split cells into groups that are timed together, in the order of their first cells."""
    groups: dict[str, list[Planned]] = {}
    for one in planned:
        groups.setdefault(one.cell.together, []).append(one)
    return list(groups.values())


def _fitting(group: list[Planned]) -> list[list[Planned]]:
    """Split a group by comparison where its frames are too large to be kept ready at once; else keep it whole."""
    rays = sum(p.cell.size**2 * p.cell.samples_per_pixel for p in group if p.timed)
    if rays * BYTES_PER_RAY <= MOST_BYTES:
        return [group]
    return [list(part) for _, part in itertools.groupby(group, key=lambda p: p.cell.comparison)]
