"""What a cluster loses on the way is asked for again, and nobody waits for what will not come."""

from __future__ import annotations

import asyncio
import logging
import subprocess
import sys
import threading
from collections.abc import Iterator
from typing import Any

import dask
import pytest
from distributed import Future, Scheduler, Status
from distributed.core import ConnectionPool, PooledRPCCall
from distributed.scheduler import KilledWorker, WorkerState

from harness.cluster import engine as engines
from harness.cluster import serving, starting
from harness.cluster.engine import SIGNS, Engine
from harness.cluster.executor import LOSSES, ClusterExecutor
from harness.cluster.places import Lost
from harness.cluster.spread import ClusterSpread
from harness.contract import FirsthitError
from tests.sleeping_device import INFO, cluster, until

pytestmark = pytest.mark.usefixtures("no_cache")

LAB1 = {"opencl:sleeping": 1.0, "on#lab1": 1.0}
let_go = threading.Event()


@pytest.fixture(autouse=True)
def undisturbed() -> Iterator[None]:
    let_go.clear()
    yield
    let_go.set()


def _answered_late(number: int) -> int:
    """Answer once the test lets go; workers are threads of this process."""
    let_go.wait(30)
    return number * number


def _ends_its_worker(_: int) -> int:
    raise KilledWorker("a task", WorkerState(**_NOWHERE), 3)


_NOWHERE: dict[str, Any] = {
    "address": "tcp://1.1.1.1:1",
    "status": Status.running,
    "pid": 1,
    "name": "w",
    "nthreads": 1,
    "memory_limit": 0,
    "local_directory": "",
    "nanny": "",
    "server_id": "w",
}


def _in_a_thread(call: Any) -> tuple[threading.Thread, list[Any]]:
    found: list[Any] = []

    def run() -> None:
        try:
            found.append(call())
        except Exception as error:
            found.append(error)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    return thread, found


def test_a_step_that_fails_at_once_is_taken_again_after_a_look_at_the_scheduler(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with cluster([LAB1]) as (_, engine, _told):
        until(lambda: engine.places())
        executor = ClusterExecutor(engine, INFO.name, engine.take(lambda _: True), lambda _: True, 5.0, 0.5)
        looks: list[int] = []

        def step(*_: Any) -> str:
            looks.append(engine._looked)
            if looks[-1] < looks[0] + 2:
                raise Lost("its connection broke, which the engine does not know yet")
            return "taken"

        monkeypatch.setattr("harness.cluster.places.Hold.step", step)
        assert executor._ask(INFO.name, "warm") == "taken" and len(looks) <= LOSSES


def test_a_worker_that_lost_a_step_is_given_none_before_it_shows_signs_of_life(monkeypatch: pytest.MonkeyPatch) -> None:
    signs = [0.0]
    seen = Engine._seen

    def heard(self: Engine, listed: dict[str, dict[str, Any]]) -> None:
        seen(self, {address: told | {"last_seen": signs[-1]} for address, told in listed.items()})

    monkeypatch.setattr(Engine, "_seen", heard)
    with cluster([LAB1]) as (_, engine, _told):
        until(lambda: engine.places())
        place = engine.take(lambda _: True)
        engine.look_again(place)  # as where its process has ended, which the scheduler does not know yet
        engine.give_back(place)
        for _ in range(SIGNS):
            engine.look_again()
            assert not engine.places() and engine.take(lambda _: True) is None
            signs.append(signs[-1] + 1.0)
        until(lambda: engine.take(lambda _: True) is place)


class HangingNanny:
    """Stand for a nanny that has started, and whose worker hangs: neither ends by itself."""

    worker_address: str | None = None
    process = None

    def __init__(self, address: str, **_: Any) -> None:
        self.rpc, self.scheduler = ConnectionPool(), PooledRPCCall(address, None)

    def __await__(self) -> Any:
        return self.rpc.__await__()

    async def finished(self) -> None:
        await asyncio.Event().wait()


def _served(monkeypatch: pytest.MonkeyPatch, until_then: Any) -> int:
    """Return what serve returns where `until_then` is done with its scheduler after a while, which then ends."""
    monkeypatch.setattr("distributed.Nanny", HangingNanny)
    monkeypatch.setattr(serving, "_listen", lambda *_: None)

    async def served() -> int:
        async with Scheduler(host="127.0.0.1", dashboard=False) as scheduler:
            serves = asyncio.create_task(serving.serve(scheduler.address, "core 1@lab1", {}, "lab1", None))  # type: ignore[arg-type]
            await until_then(serves)
        return await asyncio.wait_for(serves, 20.0)

    with dask.config.set({name: dask.config.get(name) for name in serving.QUIET}):  # which are as before after it
        return asyncio.run(served())


def test_a_worker_that_hangs_when_its_scheduler_ends_is_ended_too(monkeypatch: pytest.MonkeyPatch) -> None:
    async def a_while(serves: asyncio.Task[int]) -> None:
        await asyncio.sleep(0.3)
        assert not serves.done()

    monkeypatch.setattr(serving, "GONE_SECONDS", 0.0)
    assert _served(monkeypatch, a_while) == 0


@pytest.mark.parametrize("address", [None, "tcp://127.0.0.1:9"], ids=["as it starts", "later"])
def test_a_worker_that_does_not_answer_is_ended(monkeypatch: pytest.MonkeyPatch, address: str | None) -> None:
    async def end(serves: asyncio.Task[int]) -> None:
        await asyncio.wait([serves], timeout=20.0)

    monkeypatch.setattr(serving, "HANG_SECONDS", 0.3)
    monkeypatch.setattr(HangingNanny, "worker_address", address)
    with subprocess.Popen(["sleep", "60"]) as hanging:
        monkeypatch.setattr(HangingNanny, "process", hanging)
        assert _served(monkeypatch, end) == serving.HUNG
        hanging.kill()


def test_a_worker_that_takes_its_time_to_start_is_left_to_it(monkeypatch: pytest.MonkeyPatch) -> None:
    async def long(serves: asyncio.Task[int]) -> None:
        await asyncio.sleep(2.0)
        assert not serves.done()

    monkeypatch.setattr(serving, "HANG_SECONDS", 1.0)
    monkeypatch.setattr(serving, "GONE_SECONDS", 0.0)
    with subprocess.Popen([sys.executable, "-c", "while True: pass"]) as busy:
        monkeypatch.setattr(HangingNanny, "process", busy)
        assert _served(monkeypatch, long) == 0
        busy.kill()


def test_steps_go_through_the_scheduler_where_a_worker_is_not_reached(monkeypatch: pytest.MonkeyPatch) -> None:
    reaches, walls = Engine._reaches, [True]
    monkeypatch.setattr(Engine, "_reaches", lambda self, address: not walls and reaches(self, address))
    with cluster([LAB1]) as (_, engine, _told):
        until(lambda: engine.places())
        place = engine.take(lambda _: True)
        executor = ClusterExecutor(engine, INFO.name, place, lambda _: True, 5.0, 0.5)
        for straight in (False, True):
            assert engine.client.direct_to_workers is straight
            assert executor.warm(INFO.name, "k", None).batch == 1  # type: ignore[arg-type]
            walls.clear()
            engine.look_again(place)  # as where a step was lost
            until(lambda: engine.client.direct_to_workers)


def test_a_step_whose_process_was_given_up_is_taken_by_another_one() -> None:
    with cluster([LAB1]) as (_, engine, _told):
        until(lambda: engine.places())
        executor = ClusterExecutor(engine, INFO.name, engine.take(lambda _: True), lambda _: True, 5.0, 0.5)
        executor.warm(INFO.name, "k", None)  # type: ignore[arg-type]
        hold = executor._hold
        assert hold
        hold._actor = Mute()
        thread, found = _in_a_thread(lambda: executor.warm(INFO.name, "k", None))  # type: ignore[arg-type]
        engine.client.cancel([hold._made])  # as where the client was cut off from the scheduler for a moment
        thread.join(30)
    assert [warmed.batch for warmed in found] == [1]


class Mute:
    """Stand for a process that never answers; Dask asks it no more, and does not tell so."""

    async def step(self, _: bytes) -> Any:
        await asyncio.Event().wait()


def test_chunks_whose_scheduler_was_lost_are_asked_for_again() -> None:
    with cluster([{"cores": 1.0}]) as (_, engine, _told):
        until(lambda: engine.cores() == 1)
        thread, found = _in_a_thread(lambda: ClusterSpread(engine, None).map(_answered_late, [2, 3]))
        until(lambda: sum(name.startswith("firsthit-answer") for name in engine.client.futures) == 2)
        asked = [Future(name, engine.client) for name in engine.client.futures if name.startswith("firsthit-answer")]
        engine.client.cancel(asked)  # as a client does whose connection to the scheduler breaks
        let_go.set()
        thread.join(30)
    assert found == [[4, 9]]


def test_work_that_ends_each_of_its_workers_is_told() -> None:
    with cluster([{"cores": 1.0}]) as (_, engine, _told):
        until(lambda: engine.cores() == 1)
        with pytest.raises(FirsthitError, match="each worker that took this work of the oracle was lost"):
            ClusterSpread(engine, None).map(_ends_its_worker, [2])


def test_work_that_the_cluster_never_takes_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    with cluster([{"cores": 1.0}]) as (_, engine, _told):
        until(lambda: engine.cores() == 1)
        monkeypatch.setattr(engine.client, "submit", _refuses)
        with pytest.raises(FirsthitError, match="did not take work of the oracle 5 times; the last time: RuntimeError"):
            ClusterSpread(engine, None).map(_answered_late, [2])


def _refuses(*_: Any, **__: Any) -> Any:
    raise RuntimeError("no")


def test_a_scheduler_that_begins_is_connected_to_once_it_can_be(monkeypatch: pytest.MonkeyPatch) -> None:
    with cluster([LAB1]) as (_, engine, told):
        until(lambda: engine.places())
        connect, refused = engine._connect, []

        def begins() -> Any:
            if len(refused) < 2:
                refused.append(1)
                raise RuntimeError("half made")  # Dask raises what it will where a scheduler begins or ends
            return connect()

        monkeypatch.setattr(engine, "_connect", begins)
        engine.client.close()
        until(lambda: any("is back" in line for line in told))
        until(lambda: engine.places())


def test_a_client_that_is_not_connected_is_replaced() -> None:
    with cluster([LAB1]) as (_, engine, told):
        until(lambda: engine.places())
        first = engine.client
        first.status = "connecting"  # as one is, for ever, whose own attempt to connect again has failed
        until(lambda: any("is back" in line for line in told))
        assert engine.client is not first


def test_a_worker_that_was_silent_serves_again_when_it_speaks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Engine, "_restart", lambda *_: None)  # a worker without a nanny cannot be started again
    with cluster([LAB1]) as (_, engine, _told):
        until(lambda: engine.places())
        place = engine.places()[0]
        monkeypatch.setattr(engines, "SILENT_SECONDS", 0.0)
        until(lambda: place.gone)
        monkeypatch.setattr(engines, "SILENT_SECONDS", 30.0)
        until(lambda: engine.places())
        assert engine.places()[0] is not place


def test_what_a_worker_said_is_asked_again_where_it_was_lost_on_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    ask = Engine._asked

    class Lost:
        status = "cancelled"

        def done(self) -> bool:
            return True

        def result(self, **_: float) -> Any:
            raise RuntimeError("cancelled")

    def counted(self: Engine, address: str, resources: dict[str, float]) -> Any:
        asked.append(address)
        return Lost() if len(asked) == 1 else ask(self, address, resources)

    monkeypatch.setattr(Engine, "_asked", counted)
    with cluster([LAB1]) as (_, engine, told):
        until(lambda: engine.places())
    assert len(asked) == 2 and told == []


def test_a_client_that_is_closed_while_its_scheduler_is_away_writes_no_log(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    levels = {
        name: logging.getLogger(name).level for name in ("distributed", "distributed.client", "tornado.application")
    }
    try:
        logging.getLogger("distributed").setLevel(logging.CRITICAL)
        logging.getLogger("distributed.client").setLevel(logging.WARNING)  # as Dask sets it where it is imported
        monkeypatch.setattr("harness.cluster.starting.Engine", lambda connect, *_: connect())
        monkeypatch.setattr("dask.distributed.Client", lambda *_, **__: Closed())
        with starting._watched("lab1:8786", "lab1:8786", lambda _: None):
            logging.getLogger("distributed.client").error("it could not be connected again")
        assert capsys.readouterr().err == ""
        assert not logging.getLogger("distributed.client").isEnabledFor(logging.ERROR)
    finally:
        for name, level in levels.items():
            logging.getLogger(name).setLevel(level)


class Closed:
    """Stand for a client, and for what watches it."""

    def close(self) -> None:
        pass
