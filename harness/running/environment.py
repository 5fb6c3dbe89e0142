"""Describe where a run took place: versions, commit, machine, and its devices as their probes found them."""

from __future__ import annotations

import contextlib
import dataclasses
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict

from harness import ROOT, __version__
from harness.contract import CellStatus, DeviceInfo, FirsthitError, LostDevice, digest
from harness.devices import host
from harness.devices.executor import CellError
from harness.devices.host_arithmetic import host_arithmetic
from harness.devices.probes import BELIEVABLE, Probes
from harness.devices.steps import Executor
from harness.results import declared, git, owner, sealed, sources
from harness.results.writing import write_atomically

if TYPE_CHECKING:
    from harness.devices.fingerprint import Fingerprint

PACKAGES = ("numpy", "python-flint", "moderngl", "pyopencl")


class _KeptFingerprint(TypedDict):
    """Hold what is kept of a device's fingerprint."""

    fingerprint: dict[str, dict[str, str]]
    digest: str


_PROBES = declared.of_dataclass(Probes)
_FINGERPRINT = declared.checker(_KeptFingerprint)


def _git(*arguments: str) -> str | None:
    """Run git in the project's folder and return what it printed; None where it fails or is not here."""
    try:
        result = git.ran(ROOT, *arguments)
    except OSError:
        return None
    return result.stdout.strip() if result.returncode == 0 else None


def _is_versioned() -> bool:
    """Tell whether git keeps this file: where firsthit is installed, a repository around it is somebody else's."""
    return _git("ls-files", "--error-unmatch", str(Path(__file__))) is not None


def describe(machine: str | None = None) -> dict[str, Any]:
    """Return versions, commit and machine, as plan.json keeps them.

    `machine` is the name of this one; None: its short name in its network.
    """
    versions = {}
    for package in PACKAGES:
        try:
            versions[package] = version(package)
        except PackageNotFoundError:
            continue
    return {
        "firsthit": __version__,
        "commit": _git("rev-parse", "--short=12", "HEAD") if _is_versioned() else None,
        "dirty": _is_versioned() and bool(_git("status", "--porcelain", "--untracked-files=no")),
        "python": platform.python_version(),
        "platform": platform.platform(),
        "cpu": host.processor(),
        "machine": machine or owner.machine_name(),
        "versions": versions,
    }


def probed(
    executor: Executor, info: DeviceInfo, cache: Path | None = None, again: bool = False
) -> tuple[DeviceInfo, Probes | None]:
    """Return the device with the clock that its probes support, and what the probes found.

    With a folder `cache` this is kept there, for as long as the device, its driver, the processor and the harness stay
    as they are; where the folder cannot be written, nothing is kept. With `again` the probes run whatever is kept.
    They are None for a device with a problem; probes that fail are a problem of the device that is returned.
    """
    if info.problem:
        return info, None
    found, _ = kept_probes(info, cache) if cache and not again else (None, 0.0)
    if found is None:
        try:
            found = executor.probe(info.name)
        except CellError as error:
            if error.status is CellStatus.FAILED:
                return dataclasses.replace(info, problem=f"its probes failed: {error}"), None
            return LostDevice(**vars(info) | {"problem": str(error)}), None
        if cache:
            with contextlib.suppress(FirsthitError):
                write_atomically(_probes_file(info, cache), sealed.sealed(dataclasses.asdict(found)))
    ratio = found.clock_ratio
    believable = ratio is not None and BELIEVABLE[0] <= ratio <= BELIEVABLE[1]
    return dataclasses.replace(info, clock="device" if believable else "wall"), found


def kept_probes(info: DeviceInfo, cache: Path) -> tuple[Probes | None, float]:
    """Return what `probed` kept of a device, and when, in seconds since 1970; None and 0 where nothing was kept.

    A damaged file counts as nothing.
    """
    file = _probes_file(info, cache)
    try:
        found, since = sealed.read(file), file.stat().st_mtime
        _PROBES(found, "")
    except (OSError, ValueError):
        return None, 0.0
    return Probes(**found), since


def fingerprinted(executor: Executor, info: DeviceInfo, cache: Path | None = None, again: bool = False) -> Fingerprint:
    """Return the fingerprint of a device.

    With a folder `cache` it is kept there as what `probed` finds is, and taken anew with `again`. What is of the host
    is found each time, in this process, since that is where rays are made and errors computed. Raises FirsthitError for
    a device with a problem, and where the fingerprint cannot be taken.
    """
    if info.problem:
        raise FirsthitError(f"{info.name} has no fingerprint, since it cannot be used: {info.problem}", exit_code=3)
    found, _ = kept_fingerprint(info, cache) if cache and not again else (None, 0.0)
    if found is None:
        try:
            found = executor.fingerprint(info.name)
        except CellError as error:
            raise FirsthitError(f"the fingerprint of {info.name} cannot be taken: {error}", exit_code=3) from None
        if cache:
            kept = {"fingerprint": found, "digest": digest(found)}
            with contextlib.suppress(FirsthitError):
                write_atomically(_fingerprint_file(info, cache), sealed.sealed(kept))
    return found | {"host": host_arithmetic()}


def kept_fingerprint(info: DeviceInfo, cache: Path) -> tuple[Fingerprint | None, float]:
    """Return what `fingerprinted` kept of a device, and when, in seconds since 1970; None and 0 where nothing was kept.

    A damaged file counts as nothing.
    """
    file = _fingerprint_file(info, cache)
    try:
        kept, since = sealed.read(file), file.stat().st_mtime
        _FINGERPRINT(kept, "")
    except (OSError, ValueError):
        return None, 0.0
    return (kept["fingerprint"], since) if kept["digest"] == digest(kept["fingerprint"]) else (None, 0.0)


def _fingerprint_file(info: DeviceInfo, cache: Path) -> Path:
    """Return the file of a device's fingerprint, which is decided by what decides its probes."""
    return _probes_file(info, cache).with_suffix(".fingerprint")


def _probes_file(info: DeviceInfo, cache: Path) -> Path:
    """Return the file of a device's probes, which is named by all that decides what probes find."""
    machine = (host.processor(), host.cores(), host.settings(), sources.methodology())
    return cache / f"{digest(dataclasses.asdict(info), *machine)}.json"
