"""Keep what was found of this machine's devices in the user's cache folder, for commands that only tell of it.

An answer is believed only if all that it may depend on is as it was: the harness; the packages of bindings and drivers;
the processor, and that the machine has not been started again; the environment variables that drivers and their loaders
read; the lists by which loaders find drivers; and every file whose code ran in the worker that answered (drivers, their
compilers, and what these load). An answer that is damaged is not believed either. One that tells of no device, or of a
device with a problem, is not kept: who mends a device is not to be told that it is still broken. If no folder can be
written, nothing is kept, and nothing else changes.

Commands that make rows do not ask here. They look for devices (`discovery.discover_devices`), which replaces what is
kept.
"""

from __future__ import annotations

import contextlib
import dataclasses
import os
import platform
import stat
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, TypedDict

from harness import ROOT
from harness.contract import DeviceInfo, FirsthitError, digest
from harness.devices import host
from harness.results import declared, sealed, sources
from harness.results.writing import write_atomically

PACKAGES = (
    *("pyopencl", "moderngl", "glcontext", "numpy"),
    *("pocl-binary-distribution", "intel-opencl-rt", "intel-cmplr-lib-rt"),
)
LOADERS = (  # how names of the variables begin by which drivers are found, beside those in host.SETTINGS
    *("OCL_", "OPENCL_", "LD_", "EGL_", "__EGL_", "__GLX_", "LIBGL_", "RUSTICL_", "DRI_", "VK_"),
    *("NVIDIA_", "ROCR_", "HIP_", "HSA_", "GPU_", "AMD_", "ZE_", "SYCL_", "NEO", "DISPLAY", "WAYLAND_"),
)
OPENCL_LISTS = Path("/etc/OpenCL/vendors")
LISTS = (OPENCL_LISTS, Path("/usr/share/glvnd/egl_vendor.d"), Path("/etc/glvnd/egl_vendor.d"), Path("/etc/ld.so.cache"))
MACHINE = (Path("/proc/sys/kernel/random/boot_id"), Path("/proc/driver/nvidia/version"))
NODES = ("dri/*", "nvidia*", "kfd")  # below /dev: the hardware that drivers open


@dataclass(frozen=True)
class Kept:
    """Hold what a look at one backend found, and when it was kept, in seconds since 1970."""

    devices: tuple[DeviceInfo, ...]
    since: float


class _Record(TypedDict):
    """Hold what is kept of one backend; files are told by size and time of change."""

    surroundings: str
    files: dict[str, list[int]]
    devices: list[dict[str, Any]]


_RECORD = declared.checker(_Record)
_DEVICE = declared.of_dataclass(DeviceInfo)


def keep(backend: str, devices: Sequence[DeviceInfo], ran: Iterable[Path] | None) -> None:
    """Keep what a look at `backend` found; if that is nothing, or a device has a problem, forget what was kept.

    The problem of a broken double of a working device (one driver that is installed twice) does not count. `ran` names
    the files whose code ran in the worker. It is None if the system does not say; then nothing is kept.
    """
    place = _place()
    if place is None:
        return
    file = place / f"{backend}.json"
    working = {_base(info) for info in devices if not info.problem}
    if not devices or {_base(info) for info in devices} - working:
        with contextlib.suppress(OSError):
            file.unlink(missing_ok=True)
    elif ran is not None:
        with contextlib.suppress(FirsthitError, OSError, ValueError):
            states = {str(path): state for path in ran if (state := _state(path))}  # a compiler's files may be gone
            found = [dataclasses.asdict(info) for info in devices]
            record = {"surroundings": _surroundings(), "files": states, "devices": found}
            write_atomically(file, sealed.sealed(record))


def recall(backend: str) -> Kept | None:
    """Return what the last look at `backend` found; None if something that it may depend on has changed since."""
    place = _place()
    try:
        if place is None:
            return None
        file = place / f"{backend}.json"
        record = sealed.read(file)
        _RECORD(record, "")
        if record["surroundings"] != _surroundings():
            return None
        if any(_state(Path(path)) != state for path, state in record["files"].items()):
            return None
        return Kept(tuple(_device(facts) for facts in record["devices"]), file.stat().st_mtime)
    except (OSError, ValueError):  # not there, damaged, or of another version
        return None


def probes_folder() -> Path | None:
    """Return where `environment.probed` may keep what probes found; None if there is no cache folder."""
    place = _place()
    return None if place is None else place / "probes"


def _place() -> Path | None:
    """Return this installation's folder on this machine, in the user's cache folder; None if the user has none."""
    cache = Path(os.environ.get("XDG_CACHE_HOME", ""))
    if not cache.is_absolute():
        try:
            cache = Path.home() / ".cache"
        except RuntimeError:
            return None
    return cache / "firsthit" / digest(platform.node(), sys.prefix, str(ROOT))[:8]


def _base(info: DeviceInfo) -> str:
    """Return a device's name without its number: `opencl:pocl` of `opencl:pocl-2`."""
    return info.name.partition("-")[0]


def _device(facts: dict[str, Any]) -> DeviceInfo:
    """Make a device of what was kept of it. Raises ValueError where that is none."""
    _DEVICE(facts, "")
    return DeviceInfo(**facts | {"versions": tuple((name, number) for name, number in facts["versions"])})


def _surroundings() -> str:
    """Return a digest of what an answer may depend on, except the files whose code ran."""
    packages = {}
    for name in PACKAGES:
        with contextlib.suppress(PackageNotFoundError):
            packages[name] = version(name)
    beginnings = (*host.SETTINGS, *LOADERS)
    settings = sorted((name, ascii(value)) for name, value in os.environ.items() if name.startswith(beginnings))
    machine = [platform.node(), platform.release(), *map(_text, MACHINE), host.processor(), host.cores()]
    nodes = sorted(path for kind in NODES for path in Path("/dev").glob(kind))
    usable = [(str(path), os.access(path, os.R_OK | os.W_OK)) for path in nodes]
    python = [sys.version, sys.prefix, packages]
    return digest(sources.methodology(), python, settings, machine, usable, _lists())


def _lists() -> list[tuple[str, list[int] | None]]:
    """Return the state of the lists by which loaders find drivers, and of the drivers named there by a whole path."""
    named = [Path(os.environ[name]) for name in ("OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH") if os.environ.get(name)]
    wheel = Path(sys.prefix) / "lib" / "libintelocl.so"  # which harness/devices/opencl.py lists by itself
    files = [file for path in (*LISTS, *named) for file in (sorted(path.iterdir()) if path.is_dir() else [path])]
    drivers = [Path(_text(file).strip()) for file in files if file.suffix == ".icd"]
    return [(str(path), _state(path)) for path in (*files, wheel, *(path for path in drivers if path.is_absolute()))]


def _state(path: Path) -> list[int] | None:
    """Return size in bytes and time of change in nanoseconds of a file; None if there is no such file."""
    try:
        facts = path.stat()
    except OSError:
        return None
    return [facts.st_size, facts.st_mtime_ns] if stat.S_ISREG(facts.st_mode) else None


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
