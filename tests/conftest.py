"""What tests share: the machine's usable devices, opened once each, and small rays."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
import pytest

from harness.contract import DeviceInfo
from harness.devices import kept_answers
from harness.devices.executor import LocalExecutor
from harness.devices.interface import INSTALL, Device, find_devices, open_device


@cache
def _found(backend: str) -> list[DeviceInfo]:
    return find_devices(backend)


@cache
def usable_devices() -> tuple[DeviceInfo, ...]:
    return tuple(info for backend in INSTALL for info in _found(backend) if not info.problem)


@pytest.fixture(scope="module")
def devices_found_once() -> Iterator[None]:
    """Commands run in this process find its devices at once, instead of in a process of their own each time: that takes
    longer than what most tests are about, and tests that run commands in processes of their own do it still. What the
    user's cache folder holds of devices is left alone."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(kept_answers, "_place", lambda: None)
        patched.setattr(LocalExecutor, "find", lambda _, backend: _found(backend))
        yield


def rotation(pairs: list[tuple[Any, ...]], places: list[tuple[str, str]]) -> list[tuple[Any, tuple[str, str]]]:
    """Join each pair with one place, in turn, so that every place is used and no choice is by chance.

    Without places there is nothing to join.
    """
    return [(pair, places[i % len(places)]) for i, pair in enumerate(pairs)] if places else []


@cache
def opened(name: str) -> Device:
    return open_device(name)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "device" in metafunc.fixturenames:
        names = [info.name for info in usable_devices()]
        nothing = [pytest.param(None, marks=pytest.mark.skip("no device"))]
        metafunc.parametrize("device", names or nothing, indirect=True)


@pytest.fixture
def device(request: pytest.FixtureRequest) -> Device:
    return opened(request.param)


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(7)
