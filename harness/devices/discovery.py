"""Which devices this machine has."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor

from harness.contract import DeviceInfo
from harness.devices.executor import START_SECONDS, CellError, LocalExecutor
from harness.devices.interface import INSTALL


def discover_devices(wanted: Iterable[str] = ("all",)) -> list[DeviceInfo]:
    """Every device of every installed backend, side by side in processes of their own: a driver that crashes costs
    itself. Where `wanted` names devices, as a config does, only of the backends that it names."""
    named = {name.partition(":")[0] for name in wanted}
    backends = [backend for backend, package in INSTALL.items() if importlib.util.find_spec(package)]
    if named <= set(INSTALL):
        backends = [backend for backend in backends if backend in named]
    with ThreadPoolExecutor() as pool:
        return [info for found in pool.map(_find, backends) for info in found]


def _find(backend: str) -> list[DeviceInfo]:
    executor = LocalExecutor(START_SECONDS)
    try:
        return executor.find(backend)
    except CellError as error:
        problem = f"looking for it: {error}"
        return [DeviceInfo(f"{backend}:none", "none", "none", "none", None, False, "wall", (), problem)]
    finally:
        executor.close()
