"""Share among tests the machine's usable devices, opened once each, and a generator of random numbers."""

from __future__ import annotations

import functools
import gc
import os
import signal
import tempfile
import threading
import zlib
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from harness import plugins
from harness.conformance import dense
from harness.contract import DeviceInfo, Method
from harness.devices import kept_answers
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.interface import INSTALL, Device, find_devices, open_device
from harness.memory import Watch

gc.set_threshold(50_000, 20, 20)  # among all that tests hold, Python's own pace takes a tenth of the time of reports
signal.signal(signal.SIGINT, signal.default_int_handler)  # what a shell runs in the background ignores it otherwise
CACHES = {"PYOPENCL_NO_CACHE": "0", "POCL_KERNEL_CACHE": "1", "MESA_SHADER_CACHE_DISABLE": "false"}


_LOADED: dict[Path, Method] = {}


def _load_once(load: Callable[[Any, Path], Method]) -> Callable[[Any, Path], Method]:
    """Let a loader of methods read each of firsthit's own once for all tests. No test writes into their folders."""
    own = plugins.BUILT_IN

    def loaded(self: Any, folder: Path) -> Method:
        if folder.parent != own:
            return load(self, folder)
        if folder not in _LOADED:
            _LOADED[folder] = load(self, folder)
        return _LOADED[folder]

    return loaded


plugins._Loader._load = _load_once(plugins._Loader._load)  # type: ignore[method-assign]


@cache
def _found(backend: str) -> list[DeviceInfo]:
    return find_devices(backend)


@cache
def usable_devices() -> tuple[DeviceInfo, ...]:
    """Return the devices of this machine that have no problem, looked for once; what compiles soonest is the first."""
    usable = (info for backend in INSTALL for info in _found(backend) if not info.problem)
    return tuple(sorted(usable, key=lambda info: not info.name.startswith("opengl:")))


def all_round() -> str:
    """Return the name of a device that computes each function in both precisions: the first of OpenCL, if any.

    It is "" where there is no device.
    """
    names = [info.name for info in usable_devices()]
    return next((name for name in names if name.startswith("opencl:")), "".join(names[:1]))


@pytest.fixture(scope="module")
def devices_found_once() -> Iterator[Callable[[], None]]:
    """Let commands that run in this process find its devices at once, and hand their workers on to one another.

    Otherwise each command looks for devices in a process of its own, and starts a worker that loads its driver, which
    takes longer than what most tests are about. Tests that run commands in processes of their own still do so. What the
    user's cache folder holds of devices is left alone. Yields a function that ends the workers that are waiting,
    after which a command builds each program itself.
    """
    kept: dict[str, Any] = {}
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(kept_answers, "_place", lambda: None)
        patched.setattr(LocalExecutor, "find", lambda _, backend: _found(backend))
        _keep_workers(patched, kept)
        yield functools.partial(_end_workers, kept)
    _end_workers(kept)


def _end_workers(kept: dict[str, Any]) -> None:
    while kept:
        _, worker = kept.popitem()
        worker.connection.close()
        worker.process.wait(60)


def _keep_workers(patched: pytest.MonkeyPatch, kept: dict[str, Any]) -> None:
    """Let an executor that is closed leave its workers in `kept`, by device, and the next one take them from there.

    A worker that was lost, or left in the middle of a step, is not kept, nor one that a thread of a command started,
    since a worker ends with the thread that started it (harness.hosting.process).
    """
    start, ask, close = LocalExecutor._start, LocalExecutor._ask, LocalExecutor.close
    busy: set[Any] = set()  # workers that were asked and have not answered
    lasting: set[Any] = set()  # processes that this process's main thread started

    def started(self: LocalExecutor, device: str) -> Any:
        if device not in self._processes and device in kept:
            worker = kept.pop(device)
            self._processes[device] = replace(worker, watch=Watch(worker.process.pid, self._share))
        fresh = device not in self._processes
        worker = start(self, device)
        if fresh and threading.current_thread() is threading.main_thread():
            lasting.add(worker.process)
        return worker

    def asked(self: LocalExecutor, device: str, *arguments: Any) -> Any:
        worker = self._start(device)
        busy.add(worker)
        try:
            answer = ask(self, device, *arguments)
        except CellError:
            busy.discard(worker)
            raise
        busy.discard(worker)
        return answer

    def closed(self: LocalExecutor) -> None:
        for key, device in list(self._warm.items()):
            if self._processes.get(device) not in busy:
                self.release(device, key)
        for device, worker in list(self._processes.items()):
            if worker in busy or device in kept or worker.process not in lasting or worker.process.poll() is not None:
                continue
            self.builds(device)  # which the next command is not to tell as its own
            kept[device] = self._processes.pop(device)
        close(self)

    patched.setattr(LocalExecutor, "_start", started)
    patched.setattr(LocalExecutor, "_ask", asked)
    patched.setattr(LocalExecutor, "close", closed)


@pytest.fixture
def few_degrees(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let conform, in this process, try dense polynomials of two degrees, not of twenty."""
    monkeypatch.setattr(dense, "DEGREES", (5, 16))


def rotation(pairs: list[tuple[Any, ...]], places: list[tuple[str, str]]) -> list[tuple[Any, tuple[str, str]]]:
    """Join each pair with one place, in turn, so that every place is used and no choice is by chance.

    Returns [] where there are no places.
    """
    return [(pair, places[i % len(places)]) for i, pair in enumerate(pairs)] if places else []


@cache
def opened(name: str) -> Device:
    """Open the device of this name, once for all tests."""
    return open_device(name)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Run a test that takes `device` on each usable device; skip it where there is none."""
    if "device" in metafunc.fixturenames:
        names = [info.name for info in usable_devices()]
        nothing = [pytest.param(None, marks=pytest.mark.skip("no device"))]
        metafunc.parametrize("device", names or nothing, indirect=True)


def pytest_configure(config: pytest.Config) -> None:
    """Let tests, and the commands that they start, keep the programs that they compile, in a folder of this session.

    Many compile the same ones. The user's own cache folder is neither read nor written.
    """
    if "PYTEST_XDIST_WORKER" not in os.environ:  # which has what the process has that started it
        folder = tempfile.TemporaryDirectory(prefix="firsthit-tests-", ignore_cleanup_errors=True)
        config.add_cleanup(folder.cleanup)
        os.environ.update({**CACHES, "XDG_CACHE_HOME": folder.name})


@pytest.fixture
def no_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let commands compile each program anew: a process that dies as it writes leaves the cache locked."""
    monkeypatch.setenv("PYOPENCL_NO_CACHE", "1")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--every-case", action="store_true", help="run every case of every test on every device")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out cases that are like others; which ones is as by chance, but always the same.

    Of a test marked `one_in(n)`, every n-th case stays, and one at least. Each case of a test that has several stays on
    one device. A test without other parameters runs on every device. With `--every-case`, or where FIRSTHIT_RAYS asks
    for more rays, nothing is left out.

    Most of a case's time is its program's compilation.
    """
    if config.getoption("--every-case") or "FIRSTHIT_RAYS" in os.environ:
        return
    left_out = _beyond_its_share(items)
    left_out |= _on_other_devices([item for item in items if item not in left_out])
    config.hook.pytest_deselected(items=[item for item in items if item in left_out])
    items[:] = [item for item in items if item not in left_out]


def _beyond_its_share(items: Sequence[pytest.Item]) -> set[pytest.Item]:
    """Return the cases that the mark `one_in` leaves out."""
    marked: dict[str, list[tuple[pytest.Item, int]]] = {}
    for item in items:
        if (mark := item.get_closest_marker("one_in")) is not None:
            marked.setdefault(item.nodeid.partition("[")[0], []).append((item, *mark.args))
    left_out: set[pytest.Item] = set()
    for cases in marked.values():
        by_chance = sorted(cases, key=lambda case: zlib.crc32(case[0].nodeid.encode()))
        left_out.update(item for at, (item, step) in enumerate(by_chance) if at % step)
    return left_out


def _on_other_devices(items: Sequence[pytest.Item]) -> set[pytest.Item]:
    """Return each case on the devices that it is not left on. OpenGL's compile soonest and get more.

    The cases of a test that has one case are all left.
    """
    names = {info.name for info in usable_devices()}
    cases: dict[str, dict[str, dict[str, pytest.Item]]] = {}
    for item in items:
        parts = _parts(item, names)
        if parts is not None:
            test, case, device = parts
            cases.setdefault(test, {}).setdefault(case, {})[device] = item
    left_out: set[pytest.Item] = set()
    for test, found in cases.items():
        for case, on in found.items() if len(found) > 1 else ():
            places = sorted([*on, *(name for name in on if name.startswith("opengl:"))])
            chosen = places[zlib.crc32(f"{test} {case}".encode()) % len(places)]
            left_out.update(item for device, item in on.items() if device != chosen)
    return left_out


def _parts(item: pytest.Item, devices: Collection[str]) -> tuple[str, str, str] | None:
    """Return a test's name, its case but for the device, and the device; None where no parameter is a device."""
    if not isinstance(item, pytest.Function) or not hasattr(item, "callspec"):
        return None
    stated = item.callspec.params
    named = [name for name, value in stated.items() if isinstance(value, str) and value in devices]
    if len(named) != 1:
        return None
    test = item.nodeid.partition("[")[0]
    (device,) = named
    others = item.callspec.id.replace(stated[device], "", 1)
    return test, others, stated[device]


@pytest.fixture
def device(request: pytest.FixtureRequest) -> Device:
    """Return the open device that the test runs on."""
    return opened(request.param)


@pytest.fixture
def rng() -> np.random.Generator:
    """Return a generator of random numbers that starts the same in every test."""
    return np.random.default_rng(7)
