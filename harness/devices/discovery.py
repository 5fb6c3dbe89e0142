"""Find the devices of this machine, by looking at each backend in a process of its own."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from harness.contract import UNFOUND, DeviceInfo, LostDevice
from harness.devices import kept_answers
from harness.devices.executor import START_SECONDS, CellError, LocalExecutor
from harness.devices.interface import INSTALL, device_named, working


@dataclass(frozen=True)
class Known:
    """Hold devices, and when the oldest kept answer among them was kept, in seconds since 1970; None if all are new."""

    devices: list[DeviceInfo]
    since: float | None


def discover_devices(wanted: Iterable[str] = ("all",)) -> list[DeviceInfo]:
    """Look for every device of every installed backend, and keep the answers for `known_devices`.

    The backends are looked at side by side in processes of their own, so that a driver that crashes ends only its own
    process. If all of `wanted` are names of devices, as in a config, only the backends in these names are looked at.
    """
    named = {name.partition(":")[0] for name in wanted}
    backends = _installed()
    return _look([name for name in backends if name in named] if named <= set(INSTALL) else backends)


def usable_devices(names: Sequence[str] = ()) -> list[DeviceInfo]:
    """Look for the devices of these names or, without any, for all that work.

    Raises FirsthitError, with exit code 3, where a named one is not here or cannot be used, or none works.
    """
    found = discover_devices()
    return [device_named(name, found) for name in names] or working(found)


def known_devices(again: bool = False) -> Known:
    """Return every device, from kept answers where these still hold: to tell of devices, never to make rows.

    With `again` all backends are looked at anew. A kept answer still names a device that was taken out since, if
    nothing has changed that `harness.devices.kept_answers` can see.
    """
    backends = _installed()
    held = {name: answer for name in backends if not again and (answer := kept_answers.recall(name))}
    looked = _look([name for name in backends if name not in held])
    of_held = [info for answer in held.values() for info in answer.devices]
    devices = sorted([*of_held, *looked], key=lambda info: backends.index(info.name.partition(":")[0]))
    return Known(devices, min((answer.since for answer in held.values()), default=None))


def _installed() -> list[str]:
    return [backend for backend, package in INSTALL.items() if importlib.util.find_spec(package)]


def _look(backends: list[str]) -> list[DeviceInfo]:
    """Look at backends side by side. Where it is interrupted, their workers are killed and not waited for."""
    executors = [LocalExecutor(START_SECONDS) for _ in backends]
    with ThreadPoolExecutor() as pool:
        try:
            return [info for found in pool.map(_find, backends, executors) for info in found]
        except KeyboardInterrupt:
            for executor in executors:
                executor.kill()
            raise


def _find(backend: str, executor: LocalExecutor) -> list[DeviceInfo]:
    ran = None
    try:
        found = executor.find(backend)
        ran = executor.running_files(backend)
    except CellError as error:
        name = f"{backend}{UNFOUND}"
        found = [LostDevice(name, "none", "none", "none", None, False, "wall", (), problem=str(error))]
    finally:
        executor.close()
    kept_answers.keep(backend, found, ran)
    return found
