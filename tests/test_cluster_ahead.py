"""A cluster's worker takes several samples with one message, where it is known which are asked for next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import pytest

from harness.cluster.executor import AHEAD_SECONDS, ClusterExecutor
from harness.cluster.places import Hold
from harness.contract import CellStatus
from harness.devices.executor import CellError
from harness.devices.interface import Timing
from harness.running import run as running
from harness.running.runner import Runner
from tests.sleeping_device import INFO, SleepingExecutor, cluster, until
from tests.test_cluster import LAB1, LAB2, lone_executor, ran, rows_below

pytestmark = pytest.mark.usefixtures("no_cache")
FRAME: Any = None


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, int]]:
    """The operations that were sent, each with the number of its samples."""
    found: list[tuple[str, int]] = []
    step = Hold.step

    def counted(hold: Hold, operation: str, device: str, arguments: tuple[Any, ...], released: list[str]) -> Any:
        found.append((operation, len(arguments[0]) if operation == "samples" else 0))
        return step(hold, operation, device, arguments, released)

    monkeypatch.setattr(Hold, "step", counted)
    return found


@pytest.fixture
def lone() -> Iterator[tuple[Any, ClusterExecutor]]:
    with cluster([LAB1]) as (dask, engine, _):
        executor = lone_executor(engine)
        yield dask, executor
        executor.close()


@pytest.fixture(autouse=True)
def steps(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The keys of the samples that the device took, in their order; each is told to take 1 ms a repetition."""
    taken: list[str] = []

    def sample(self: SleepingExecutor, device: str, key: str, frame: Any, batch: int) -> Timing:
        del self, device, frame
        taken.append(key)
        if key in SleepingExecutor.fails:
            raise SleepingExecutor.fails.pop(key)
        return Timing(float(batch), None, float(len(taken)))

    monkeypatch.setattr(SleepingExecutor, "seconds", 0.0)
    monkeypatch.setattr(SleepingExecutor, "fails", {})
    monkeypatch.setattr(SleepingExecutor, "sample", sample)
    return taken


def warmed(executor: ClusterExecutor, keys: Sequence[str]) -> None:
    """Warm frames, and take a sample of each, so that the executor knows how long one takes."""
    for key in keys:
        executor.warm(INFO.name, key, FRAME)
    take(executor, [(key, 1) for key in keys])


def take(executor: ClusterExecutor, samples: Sequence[tuple[str, int]]) -> list[float]:
    """Take samples that are expected, and return what each tells of its place in the device's order."""
    executor.expect(samples)
    return [executor.sample(INFO.name, key, FRAME, batch).processor_ms or 0.0 for key, batch in samples]


def test_expected_samples_go_with_one_message_and_come_in_their_order(
    lone: tuple[Any, ClusterExecutor], asked: list[Any], steps: list[str]
) -> None:
    _, executor = lone
    warmed(executor, "ab")
    assert [what for what, _ in asked] == ["warm", "warm", "samples", "samples"], "how long they take is not known yet"
    asked.clear()
    assert take(executor, [("b", 1), ("a", 1), ("a", 1), ("b", 1)]) == [3.0, 4.0, 5.0, 6.0]
    assert asked == [("samples", 4)] and steps == ["a", "b", "b", "a", "a", "b"]


def test_no_more_is_taken_with_one_message_than_in_a_short_time(
    lone: tuple[Any, ClusterExecutor], asked: list[Any]
) -> None:
    _, executor = lone
    long = int(1e3 * AHEAD_SECONDS / 3) - 1
    executor.warm(INFO.name, "a", FRAME)
    take(executor, [("a", long)])
    asked.clear()
    take(executor, [("a", long)] * 7)
    assert asked == [("samples", 3), ("samples", 3), ("samples", 1)]


def test_what_is_not_asked_for_after_all_is_not_answered_later(
    lone: tuple[Any, ClusterExecutor], steps: list[str]
) -> None:
    _, executor = lone
    warmed(executor, "ab")
    executor.expect([("a", 1), ("b", 1), ("a", 1)])
    assert executor.sample(INFO.name, "a", FRAME, 1).processor_ms == 3.0
    assert take(executor, [("a", 1), ("b", 1)]) == [6.0, 7.0], "those of a round that was given up are old"
    assert steps == ["a", "b", "a", "b", "a", "a", "b"]


def test_a_frame_that_fails_costs_itself_alone(lone: tuple[Any, ClusterExecutor], steps: list[str]) -> None:
    _, executor = lone
    warmed(executor, "abc")
    SleepingExecutor.fails["b"] = CellError(CellStatus.TIMEOUT, "sample took longer than 1 s; killed")
    executor.expect([("a", 1), ("b", 1), ("c", 1), ("a", 1)])
    assert executor.sample(INFO.name, "a", FRAME, 1).processor_ms == 4.0
    with pytest.raises(CellError, match="sample took longer than 1 s; killed") as raised:
        executor.sample(INFO.name, "b", FRAME, 1)
    assert raised.value.status is CellStatus.TIMEOUT
    assert [executor.sample(INFO.name, key, FRAME, 1).processor_ms for key in "ca"] == [6.0, 7.0]
    assert steps[3:] == ["a", "b", "c", "a"], "nothing is taken twice"


def test_a_frame_that_is_lost_among_them_is_warmed_again(
    lone: tuple[Any, ClusterExecutor], asked: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    _, executor = lone
    warmed(executor, "ab")
    held, cold = SleepingExecutor.holds, ["b"]
    monkeypatch.setattr(
        SleepingExecutor, "holds", lambda self, key: not (key in cold and not cold.remove(key)) and held(self, key)
    )
    asked.clear()
    assert take(executor, [("a", 1), ("b", 1)]) == [3.0, 4.0]
    assert asked == [("samples", 2), ("samples", 1)], "it was there again when it was asked for alone"
    cold += ["a"]
    asked.clear()
    assert take(executor, [("a", 1), ("b", 1)]) == [5.0, 6.0]
    assert asked == [("samples", 2), ("warm", 0), ("samples", 1), ("samples", 1)]


def test_no_sample_of_a_lost_worker_counts_after_a_move() -> None:
    with cluster([LAB1]) as (dask, engine, _):
        executor = lone_executor(engine)
        warmed(executor, "a")
        executor.expect([("a", 1)] * 3)
        assert executor.sample(INFO.name, "a", FRAME, 1).processor_ms == 2.0
        dask.sync(dask.workers_of_test[0].close, timeout=1)
        until(lambda: not engine.places())
        dask.add(LAB2)
        executor.warm(INFO.name, "b", FRAME)
        assert executor.moves == 1
        assert executor.sample(INFO.name, "a", FRAME, 1).processor_ms == 5.0, "3 and 4 were taken before the move"
        executor.close()


def test_a_run_asks_for_a_round_with_one_message_and_for_the_first_ones_together(
    tmp_path: Any, asked: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[list[tuple[str, int]]] = []
    certain = Runner._certain
    monkeypatch.setattr(Runner, "_certain", lambda *what: told.append(certain(*what)) or told[-1])
    monkeypatch.setattr("harness.cluster.fleet.SETTLE_SECONDS", 0.2)
    with cluster([LAB1]) as (_, engine, _):
        found: running.Run = ran(tmp_path, engine)
    assert (len(found.rows), found.unfinished) == (4, 0)
    assert all(len(row["time"]["samples_ms"]) == 3 for row in rows_below(tmp_path))
    assert [len(samples) for samples in told] == [4, 2, 2] * 2, "two rounds are certain, of two cells in each group"
    assert [count for what, count in asked if what == "samples"] == [1, 1, 2, 2] * 2
