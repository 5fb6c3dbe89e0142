"""Share among tests the machine's usable devices, opened once each, and a generator of random numbers."""

from __future__ import annotations

import signal
import zlib
from collections.abc import Collection, Iterator
from functools import cache
from typing import Any

import numpy as np
import pytest

from harness.contract import DeviceInfo
from harness.devices import kept_answers
from harness.devices.executor import LocalExecutor
from harness.devices.interface import INSTALL, Device, find_devices, open_device

signal.signal(signal.SIGINT, signal.default_int_handler)  # what a shell runs in the background ignores it otherwise


@cache
def _found(backend: str) -> list[DeviceInfo]:
    return find_devices(backend)


@cache
def usable_devices() -> tuple[DeviceInfo, ...]:
    """Return the devices of this machine that have no problem, looked for once."""
    return tuple(info for backend in INSTALL for info in _found(backend) if not info.problem)


@pytest.fixture(scope="module")
def devices_found_once() -> Iterator[None]:
    """Let commands that run in this process find its devices at once.

    Otherwise each command looks for them in a process of its own, which takes longer than what most tests are about.
    Tests that run commands in processes of their own still do so. What the user's cache folder holds of devices is left
    alone.
    """
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(kept_answers, "_place", lambda: None)
        patched.setattr(LocalExecutor, "find", lambda _, backend: _found(backend))
        yield


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


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--every-device", action="store_true", help="run each case on every device, not on one in turn")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave each case of a test that has several cases on one device; which one is as by chance, but always the same.

    Most of a case's time is its program's compilation. A test without other parameters runs on every device, and so
    does each case with `--every-device`.
    """
    if config.getoption("--every-device"):
        return
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
            chosen = sorted(on)[zlib.crc32(f"{test} {case}".encode()) % len(on)]
            left_out.update(item for device, item in on.items() if device != chosen)
    config.hook.pytest_deselected(items=[item for item in items if item in left_out])
    items[:] = [item for item in items if item not in left_out]


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
