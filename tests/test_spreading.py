"""Work that is spread over processes: the same bits, no work beside a timed sample, and no process that is left."""

from __future__ import annotations

import contextlib
import itertools
import linecache
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import fields
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
import pytest

import firsthit
import surfaces
from harness import memory, spreading
from harness.cli import main
from harness.contract import FirsthitError, Surface, Truth, View
from harness.devices.executor import LocalExecutor
from harness.oracle import fast, first_hits, parts
from harness.running.trace import usable_device
from harness.spreading import pool as pools
from harness.spreading.pool import Pool
from harness.stopping import Stopped
from tests import spread_work

ROOT = Path(__file__).parents[1]
linux = pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")


@pytest.fixture
def pool() -> Iterator[Pool]:
    made = Pool(2)
    yield made
    made.close()


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hand work out after its first chunk, however little is left."""
    monkeypatch.setattr(pools, "STARTING", -1e3)
    monkeypatch.setattr(pools, "SENDING", -1e3)


def is_running(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except (OSError, ValueError):
        return False


def ended(pids: list[int], seconds: float = 60.0) -> bool:
    """Tell whether processes end within some seconds."""
    end = time.monotonic() + seconds
    while any(map(is_running, pids)) and time.monotonic() < end:
        time.sleep(0.02)
    return not any(map(is_running, pids))


def bits(truth: Truth) -> list[bytes]:
    return [getattr(truth, field.name).tobytes() for field in fields(Truth)]


def hard_rays(surface: Surface, side: int) -> np.ndarray:
    """Return side² rays of a picture, and among them some through the origin, which take the slow path of a cone."""
    rays = firsthit.rays_of(View("oblique", azimuth=30, elevation=35), surface, side)
    starts = np.array([(x, 0.5, 2) for x in np.linspace(-1, 1, 12)], np.float32)
    through = np.concatenate([starts, -starts], axis=1)
    return np.concatenate([rays[: side * side // 2], through, rays[side * side // 2 :]])


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize("formula", ["x^2 + y^2 - z^2 + x^3/3", "abs(x) + y^2 - z^2 + exp(x) - 1"])
def test_the_oracle_answers_the_same_bits_with_any_number_of_processes(
    formula: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fast, "BLOCK", 128)
    monkeypatch.setattr(parts, "CLASSIFIED", 64)
    surface = surfaces.from_formula(formula, "sphere:1.5")
    rays, handed = hard_rays(surface, 20), set()
    alone = first_hits(surface, rays)
    assert len(np.unique(alone.status)) > 1

    def watched(self: Pool, function: Callable[..., Any], chunks: Any, of: Callable[..., Any] = Pool.map) -> Any:
        handed.add(function)
        return of(self, function, chunks)

    monkeypatch.setattr(Pool, "map", watched)
    for jobs in (1, 2):
        with pools.over(jobs):
            assert bits(first_hits(surface, rays)) == bits(alone)
        assert handed == ({parts._fast, parts._slow, parts._estimated} if jobs == 2 else set())


def test_blocks_of_rays_are_those_of_one_call(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is computed on many rays at once is always computed on the same ones."""
    surface = surfaces.get("torus")
    rays = firsthit.rays_of(View("front"), surface, 60)
    taken: dict[Any, list[int]] = {}

    def answers(function: Callable[[Any], Any], chunks: list[Any], _: float) -> list[Any]:
        taken[function] = [len(chunk.rays) for chunk in chunks]
        return [function(chunk) for chunk in chunks]

    monkeypatch.setattr(spreading, "answers", answers)
    first_hits(surface, rays)
    assert taken[parts._fast] == [2048, 1552] and taken[parts._estimated] == [1024, 1024, 1024, 528]


def test_little_work_starts_no_process(pool: Pool) -> None:
    with spreading.over(pool):
        assert [two for two, _ in spreading.answers(spread_work.doubled, range(6))] == [0, 2, 4, 6, 8, 10]
        first_hits(surfaces.get("torus"), firsthit.rays_of(View("front"), surfaces.get("torus"), 32))
    assert pool.pids == []


def test_answers_come_in_the_order_of_chunks(pool: Pool) -> None:
    found = pool.map(spread_work.doubled, range(40))
    assert [two for two, _ in found] == list(range(0, 80, 2))
    assert {who for _, who in found} == set(pool.pids) and len(pool.pids) == 2 and os.getpid() not in pool.pids


def test_a_worker_that_dies_costs_a_second_try(pool: Pool, tmp_path: Path) -> None:
    assert pool.map(spread_work.dies, [tmp_path / "marker"]) == ["answered"]
    with pytest.raises(FirsthitError, match=r"worker process was killed by signal KILL, twice .*--jobs 1") as error:
        pool.map(spread_work.dies, [tmp_path / "marker", None])
    assert error.value.exit_code == 3
    assert pool.map(spread_work.doubled, [1])[0][0] == 2, "the pool goes on with other workers"
    for pid in pool.pids:  # as a system out of memory ends whoever waits
        os.kill(pid, signal.SIGKILL)
    assert pool.map(spread_work.doubled, [1])[0][0] == 2


@linux
def test_nothing_is_left_of_work_that_failed(pool: Pool) -> None:
    pool.map(spread_work.doubled, range(10))
    before, began = pool.pids, time.monotonic()
    with pytest.raises(FirsthitError, match="no chunk of work") as error:
        pool.map(spread_work.fails_or_sleeps, [60.0, 0.0, 60.0])
    assert error.value.exit_code == 3 and time.monotonic() - began < 30
    assert sum(map(is_running, before)) <= 1 and len(pool.pids) <= 1, "a worker goes on with what nobody waits for"


def test_a_mistake_of_ours_says_where_it_was_made(pool: Pool) -> None:
    with pytest.raises(ZeroDivisionError) as error:
        pool.map(spread_work.breaks, [1])
    assert "spread_work.py" in error.value.__notes__[0]


@linux
def test_a_worker_has_its_part_of_the_memory(monkeypatch: pytest.MonkeyPatch, pool: Pool) -> None:
    monkeypatch.setattr(memory, "of_machine", lambda: int(1e9))
    with pytest.raises(FirsthitError, match=r"held more than 0\.25 GB of memory, its part of what all may hold, twice"):
        pool.map(spread_work.holds, [400_000_000])


PLAIN = """
import firsthit
from harness.spreading import pool
print("begins", flush=True)
pool.STARTING = pool.SENDING = -1e3
rays = firsthit.rays_of(firsthit.View("front"), "sphere", 70)
print(firsthit.oracle("sphere", rays, jobs=2).status.sum())
"""
WAITING = """
from harness import stopping
from harness.spreading import pool
from tests import spread_work
with pool.over(2), stopping.stoppable():
    made = pool.spreading.taker()
    made.map(spread_work.fails_or_sleeps, [0.01, 0.01])
    print(*made.pids, flush=True)
    made.map(spread_work.fails_or_sleeps, [60.0, 60.0])
"""
OPTIONS: dict[str, Any] = {"env": os.environ | {"PYTHONPATH": str(ROOT)}, "text": True, "stdout": subprocess.PIPE}


def test_a_script_needs_no_main_guard(tmp_path: Path) -> None:
    (tmp_path / "plain.py").write_text(PLAIN)
    told = subprocess.run([sys.executable, str(tmp_path / "plain.py")], **OPTIONS, timeout=120).stdout.split()
    rays = firsthit.rays_of(View("front"), "sphere", 70)
    assert told == ["begins", str(firsthit.oracle("sphere", rays, jobs=1).status.sum())]


@pytest.mark.timeout(120)
def test_a_stop_between_any_two_steps_of_a_map_leaves_the_pool_able_to_close() -> None:
    """A signal's handler raises wherever the main thread is; so this raises at each line in turn, until none is left.

    No handler runs between the body of a `with` and its end, where Python traces the line once more.
    """
    for step in itertools.count():
        made, steps = Pool(1), 0

        def traced(frame: FrameType, event: str, _: Any, step: int = step) -> Any:
            nonlocal steps
            text = linecache.getline(frame.f_code.co_filename, frame.f_lineno).strip()
            inside = Path(frame.f_code.co_filename).name in ("pool.py", "thread.py", "_base.py")
            if event == "line" and inside and not text.startswith("with "):
                steps += 1
                if steps == step + 1:
                    raise Stopped(signal.SIGTERM)
            return traced

        before = sys.gettrace()
        sys.settrace(traced)
        try:
            with contextlib.suppress(Stopped):
                made.map(spread_work.fails_or_sleeps, [0.001] * 2)
        finally:
            sys.settrace(before)
            pids = made.pids
            made.close()
        assert ended(pids, 10.0), step
        if steps <= step:
            break
    assert step > 10


@linux
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
def test_workers_end_with_their_command_however_it_ends(number: signal.Signals) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", WAITING], start_new_session=True, stderr=subprocess.PIPE, **OPTIONS
    ) as waiting:
        assert waiting.stdout and waiting.stderr
        try:
            pids = list(map(int, waiting.stdout.readline().split()))
            assert pids and all(map(is_running, pids))
            os.killpg(waiting.pid, number) if number != signal.SIGKILL else waiting.kill()
            assert ended([waiting.pid, *pids]), f"{number.name} left processes"
        finally:
            waiting.kill()
        assert "spreading.serving" not in waiting.stderr.read(), "a worker complains"


CONFIG = """title = "Nothing beside a timed sample"
surfaces = ["torus"]
sizes = [16]
devices = ["{device}"]
[[method]]
name = "newton"
[accuracy]
size = 50
[budget]
seconds = 0.01
rounds = 8
repetitions = 8
"""


@pytest.mark.usefixtures("at_once", "devices_found_once")
def test_nothing_runs_beside_a_timed_sample(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Maps and samples never overlap, and workers spend no time while samples are taken."""
    try:
        device = usable_device().name
    except FirsthitError as none:
        pytest.skip(str(none))
    spans: list[tuple[str, float, float]] = []
    spent: list[float] = []
    held: list[Pool] = []

    def watched(kind: str, of: Callable[..., Any]) -> Callable[..., Any]:
        def call(self: Any, *arguments: Any) -> Any:
            if kind == "map":
                held[:] = [self]
            began, before = time.monotonic(), cpu_seconds(held)
            try:
                return of(self, *arguments)
            finally:
                spans.append((kind, began, time.monotonic()))
                if kind == "sample":
                    spent.append(cpu_seconds(held) - before)

        return call

    monkeypatch.setattr(Pool, "map", watched("map", Pool.map))
    monkeypatch.setattr(LocalExecutor, "sample", watched("sample", LocalExecutor.sample))
    (tmp_path / "beside.toml").write_text(CONFIG.format(device=device))
    assert main(["run", "-q", str(tmp_path / "beside.toml"), "--runs", str(tmp_path), "--jobs", "2"]) == 0
    spans.sort(key=lambda span: span[1])
    assert {kind for kind, *_ in spans} == {"map", "sample"} and held[0].pids == [], "the pool outlived the command"
    assert all(before[2] <= after[1] for before, after in itertools.pairwise(spans))
    assert len(spent) >= 8 and sum(spent) == 0.0


def cpu_seconds(held: list[Pool]) -> float:
    """Return the processor time that the workers of pools have taken, to a hundredth of a second; 0 without /proc."""
    ticks = 0
    for pid in (pid for pool in held for pid in pool.pids):
        if sys.platform == "linux":
            found = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
            ticks += int(found[11]) + int(found[12])
    return ticks / 100.0
