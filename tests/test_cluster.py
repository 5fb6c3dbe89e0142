"""A cluster takes steps to devices elsewhere; its workers die, and rows are those of a run without it."""

from __future__ import annotations

import contextlib
import json
import shutil
import threading
import time
from pathlib import Path
from typing import Any

import pytest

import firsthit
from harness.cluster import admission
from harness.cluster.executor import LOSSES, TRIES, ClusterExecutor
from harness.cluster.fleet import ClusterFleet
from harness.cluster.naming import named
from harness.cluster.places import Hold, Lost, Place
from harness.cluster.spread import ClusterSpread
from harness.contract import CellStatus, FirsthitError
from harness.devices.executor import CellError
from harness.devices.host import Host
from harness.running import run as running
from tests.sleeping_device import HOST, INFO, SleepingExecutor, announce, cluster, config, until

pytestmark = pytest.mark.usefixtures("no_cache")

LAB1, LAB2 = {"opencl:sleeping": 1.0, "on#lab1": 1.0}, {"opencl:sleeping": 1.0, "on#lab2": 1.0}


@pytest.fixture(autouse=True)
def steps(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, str]]:
    monkeypatch.setattr(SleepingExecutor, "steps", [])
    monkeypatch.setattr(SleepingExecutor, "fails", {})
    return SleepingExecutor.steps


def rows_below(folder: Path) -> list[dict[str, Any]]:
    return [json.loads(path.read_text()) for path in sorted(folder.rglob("cells/*.json"))]


def ran(folder: Path, engine: Any, **options: Any) -> running.Run:
    given = running.read(config(folder))
    fleet = ClusterFleet(engine, 20.0)
    return running.run(given, folder / "runs", "firsthit run t", fleet=fleet, **options)


def test_rows_name_the_device_and_a_second_run_has_nothing_to_do(tmp_path: Path, steps: list[Any]) -> None:
    with cluster([LAB1]) as (_, engine, told):
        first = ran(tmp_path, engine)
        assert (len(first.rows), first.unfinished) == (4, 0)
        count = len(steps)
        assert count and {device for _, device in steps} == {"opencl:sleeping"}
        again = ran(tmp_path, engine)
    assert (len(again.rows), len(again.reused), len(steps), told) == (0, 4, count, [])
    rows = rows_below(tmp_path)
    assert {row["device"] for row in rows} == {"opencl:sleeping"}
    assert {row["identity"]["processor"] for row in rows} == {"a processor"}, "the machine of the device decides"
    assert all(row["time"]["sittings"] == [len(row["time"]["samples_ms"])] for row in rows)


def test_a_worker_that_dies_is_replaced_and_its_step_taken_again(tmp_path: Path, steps: list[Any]) -> None:
    with cluster([LAB1, LAB2]) as (dask, engine, _):
        until(lambda: len(engine.places()) == 2)

        class Killer(running.Watcher):
            killed = False

            def cell(self, slot: str, row: Any) -> None:
                del slot, row
                if not self.killed and any(name == "sample" for name, _ in steps):
                    self.killed = True
                    dask.sync(dask.workers_of_test[0].close, timeout=1)

        watcher = Killer()
        found = ran(tmp_path, engine, watcher=watcher)
    assert watcher.killed and (len(found.rows), found.unfinished) == (4, 0)
    assert len({row["slot"] for row in rows_below(tmp_path)}) == 4


def lone_executor(engine: Any, place: Place | None = None) -> ClusterExecutor:
    until(lambda: engine.places())
    place = place or engine.take(lambda _: True)
    return ClusterExecutor(engine, INFO.name, place, lambda _: True, 5.0, 0.5)


def test_a_frame_is_warmed_again_elsewhere_and_that_is_told_as_a_move(steps: list[Any]) -> None:
    with cluster([LAB1]) as (dask, engine, _):
        executor = lone_executor(engine)
        executor.warm(INFO.name, "k", None)  # type: ignore[arg-type]
        executor.sample(INFO.name, "k", None, 1)  # type: ignore[arg-type]
        assert executor.moves == 0 and executor.where == {"machine": "lab1"}
        dask.sync(dask.workers_of_test[0].close, timeout=1)
        dask.add(LAB2)
        executor.sample(INFO.name, "k", None, 1)  # type: ignore[arg-type]
        assert executor.moves == 1 and executor.where == {"machine": "lab2"}
        assert [name for name, _ in steps][-2:] == ["warm", "sample"]
        executor.close()


def test_a_device_that_does_not_come_back_fails_its_steps_and_serves_again_once_it_does() -> None:
    with cluster([LAB1], patience=0.3) as (dask, engine, _):
        executor = lone_executor(engine)
        dask.sync(dask.workers_of_test[0].close, timeout=1)
        until(lambda: not engine.places())
        for _ in range(2):
            with pytest.raises(CellError, match=r"the worker of opencl:sleeping was lost.*--retry failed") as raised:
                executor.warm(INFO.name, "k", None)  # type: ignore[arg-type]
            assert raised.value.status is CellStatus.FAILED
        dask.add(LAB1)
        until(lambda: engine.places())
        executor.warm(INFO.name, "k", None)  # type: ignore[arg-type]


def test_a_device_that_is_still_being_probed_is_waited_for_beyond_the_patience(monkeypatch: pytest.MonkeyPatch) -> None:
    with cluster([LAB1], patience=0.1) as (dask, engine, _):
        executor = lone_executor(engine)
        monkeypatch.setattr("harness.cluster.engine.announce", announced_late)
        dask.add(LAB1)
        until(engine.asking)
        dask.sync(dask.workers_of_test[0].close, timeout=1)
        assert executor.warm(INFO.name, "k", None).batch == 1  # type: ignore[arg-type]


def announced_late(resources: Any) -> dict[str, Any]:
    time.sleep(1.0)
    return announce(resources)


def test_what_a_device_does_costs_the_step_and_no_worker() -> None:
    with cluster([LAB1]) as (_, engine, _told):
        executor = lone_executor(engine)
        SleepingExecutor.fails["warm"] = CellError(CellStatus.TIMEOUT, "warm took longer than 5 s; killed")
        with pytest.raises(CellError, match="warm took longer than 5 s; killed") as raised:
            executor.warm(INFO.name, "k", None)  # type: ignore[arg-type]
        assert raised.value.status is CellStatus.TIMEOUT
        assert executor.warm(INFO.name, "k", None).batch == 1 and executor.moves == 0  # type: ignore[arg-type]


def test_a_step_that_ends_each_worker_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    tries = []

    def step(hold: Hold, *_: Any) -> None:
        tries.append(hold)
        hold.sent = True
        raise Lost("as if it were killed")

    monkeypatch.setattr(Hold, "step", step)
    with cluster([LAB1]) as (_, engine, _told):
        executor = lone_executor(engine)
        with pytest.raises(CellError, match=f"warm lost its worker {LOSSES} times; the last time: as if") as raised:
            executor.warm(INFO.name, "k", None)  # type: ignore[arg-type]
        assert raised.value.status is CellStatus.CRASHED and len(tries) == LOSSES


def test_a_step_is_not_blamed_for_workers_that_are_lost_before_they_have_it(monkeypatch: pytest.MonkeyPatch) -> None:
    left = [TRIES - 1]
    asked = Hold._asked

    async def lost_at_first(hold: Hold, request: bytes) -> Any:
        await hold._made
        if left[0] > 0:
            left[0] -= 1
            raise OSError("as if its process had been killed a moment ago")
        return await asked(hold, request)

    monkeypatch.setattr(Hold, "_asked", lost_at_first)
    monkeypatch.setattr("harness.cluster.engine.SIGNS", 0)
    with cluster([LAB1]) as (_, engine, _told):
        executor = lone_executor(engine)
        assert executor.warm(INFO.name, "k", None).batch == 1 and left == [0]  # type: ignore[arg-type]
        left[0] = TRIES
        with pytest.raises(CellError, match=f"no worker stayed .* warm, in {TRIES} tries.*as if.*--retry") as raised:
            executor.warm(INFO.name, "k", None)  # type: ignore[arg-type]
        assert raised.value.status is CellStatus.FAILED


def test_a_worker_of_other_code_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("harness.cluster.engine.code", lambda: {"harness/devices/worker.py": "other"})
    with cluster([LAB1]) as (_, engine, told):
        until(lambda: told)
        assert "runs other code than this command" in told[0] and not engine.places()


def test_the_scheduler_is_given_up_after_a_while_and_the_run_says_how_to_go_on(tmp_path: Path) -> None:
    with cluster([LAB1], patience=0.5) as (dask, engine, told):
        until(lambda: engine.places())
        engine._connect = _refused

        class Killer(running.Watcher):
            killed = False

            def cell(self, slot: str, row: Any) -> None:
                del slot
                if row and not self.killed:
                    self.killed = True
                    threading.Thread(target=lambda: dask.sync(dask.scheduler.close), daemon=True).start()

        with pytest.raises(FirsthitError, match=r"did not come back within 0 s; finished cells are kept.*same command"):
            ran(tmp_path, engine, watcher=Killer())
    assert any("waiting for it" in line for line in told)
    assert {row["status"] for row in rows_below(tmp_path)} == {"ok"}, "no cell fails since a scheduler was lost"


def _refused() -> Any:
    raise OSError("refused")


def test_chunks_are_answered_in_order_and_errors_are_raised() -> None:
    with cluster([{"cores": 1.0}, {"cores": 1.0}]) as (_, engine, _told):
        until(lambda: engine.cores() == 2)
        spread = ClusterSpread(engine, None)
        assert spread.map(_square, list(range(20))) == [n * n for n in range(20)]
        with pytest.raises(FirsthitError, match="it is 3"):
            spread.map(_fails_at_three, [1, 2, 3])


def _square(number: int) -> int:
    return number * number


def _fails_at_three(number: int) -> int:
    if number == 3:
        raise FirsthitError("it is 3")
    return number


def place(machine: str, processor: str = "a processor", device: str = "opencl:sleeping") -> Place:
    from dataclasses import replace

    return Place("tcp://1", machine, device, replace(INFO, name=device), None, Host(processor, 2, HOST.settings))


def test_alike_devices_have_one_name_and_others_that_of_their_machine() -> None:
    alike = named([place("lab2"), place("lab1")], ["all"])
    assert alike.machines == {"opencl:sleeping": ("lab1", "lab2")}
    apart = named([place("lab1"), place("lab2", "another")], ["all"])
    assert list(apart.tried) == ["opencl:sleeping@lab1", "opencl:sleeping@lab2"]
    assert apart.tried["opencl:sleeping@lab2"][0].name == "opencl:sleeping@lab2"
    assert apart.hosts["opencl:sleeping@lab2"].processor == "another"
    assert list(named([place("lab1")], ["opencl:sleeping@lab1"]).tried) == ["opencl:sleeping@lab1"]
    with pytest.raises(FirsthitError, match=r"several devices.*opencl:sleeping@lab1, opencl:sleeping@lab2"):
        named([place("lab1"), place("lab2", "another")], ["opencl:sleeping"])


def test_nothing_runs_beside_a_timed_step_and_who_works_waits_for_no_second_turn(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(admission, "_folder", lambda _: tmp_path)
    inside: list[str] = []
    seen: list[list[str]] = []

    def work(name: str, alone: bool) -> None:
        for _ in range(10):
            with admission.alone("d", whole_machine=True) if alone else admission.beside():
                inside.append(name)
                time.sleep(0.001)
                seen.append([name, *inside])
                inside.remove(name)

    threads = [
        threading.Thread(target=work, args=(f"{k}{n}", k == "timed")) for k in ("timed", "other") for n in (1, 2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(20)
    assert len(seen) == 40
    assert all(len(names) == 2 for first, *names in seen if first.startswith("timed") for names in [[first, *names]])
    with admission.beside(), admission.beside(), admission.away(), admission.alone("d", whole_machine=True):
        pass


def test_a_folder_of_locks_that_was_tidied_away_is_made_again(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    for _ in range(2):
        with admission.alone("d", whole_machine=True):
            (folder,) = tmp_path.iterdir()
            assert {file.name for file in folder.iterdir()} == {"gate.lock", "room.lock"}
        shutil.rmtree(folder)


def test_python_runs_on_a_cluster_as_the_command_does(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, steps: list[Any]
) -> None:
    told: list[str] = []
    with cluster([LAB1, {"cores": 1.0}]) as (_, engine, _told):
        until(lambda: engine.places() and engine.cores())
        monkeypatch.setattr("harness.cluster.starting._watched", lambda *_: contextlib.nullcontext(engine))
        where = {"runs": tmp_path / "runs", "cluster": "lab1:8786"}
        found = firsthit.run(config(tmp_path), **where, tell=told.append)
    assert (len(found.rows), found.unfinished) == (4, 0) and steps
    assert {row["device"] for row in rows_below(tmp_path)} == {"opencl:sleeping"}
    assert json.loads((found.folder / "plan.json").read_text())["command"].endswith("--cluster lab1:8786")
    with pytest.raises(FirsthitError, match="--cluster 'nowhere': write HOST:PORT of a Dask scheduler"):
        firsthit.run("quick", runs=tmp_path, cluster="nowhere")
