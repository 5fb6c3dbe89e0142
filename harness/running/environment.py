"""Where a run took place: versions, commit, machine, and its devices as their probes found them."""

from __future__ import annotations

import dataclasses
import json
import platform
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from harness import __version__
from harness.contract import DeviceInfo, digest
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.probes import BELIEVABLE
from harness.experiment import identity
from harness.results import sources
from harness.results.store import write_atomically

ROOT = Path(__file__).parents[2]
PACKAGES = ("numpy", "sympy", "python-flint", "moderngl", "pyopencl")


def _git(*arguments: str) -> str | None:
    try:
        result = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=False)
    except OSError:
        return None
    return result.stdout.strip() if result.returncode == 0 else None


def _is_versioned() -> bool:
    """Whether git keeps this file: where firsthit is installed, a repository around it is somebody else's."""
    return _git("ls-files", "--error-unmatch", str(Path(__file__))) is not None


def describe() -> dict[str, Any]:
    """Versions, commit and machine, as plan.json keeps them."""
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
        "cpu": identity.processor(),
        "versions": versions,
    }


def probed(executor: LocalExecutor, info: DeviceInfo, cache: Path | None = None) -> tuple[DeviceInfo, dict[str, Any]]:
    """The device with the clock that its probes support, and what they found.

    With a `cache` folder the probes are kept there, for as long as the device, its driver, the processor and the
    harness stay as they are.
    """
    if info.problem:
        return info, {}
    host = (identity.processor(), identity.cores(), identity.settings(), sources.methodology())
    path = cache / f"{digest(dataclasses.asdict(info), *host)}.json" if cache else None
    found: dict[str, Any]
    try:
        found = json.loads(path.read_text(encoding="utf-8")) if path else {}
    except (OSError, ValueError):
        found = {}
    if not found:
        try:
            found = dataclasses.asdict(executor.probe(info.name))
        except CellError as error:
            return dataclasses.replace(info, problem=f"its probes failed: {error}"), {}
        if path:
            write_atomically(path, json.dumps(found).encode())
    ratio = found["clock_ratio"]
    believable = ratio is not None and BELIEVABLE[0] <= ratio <= BELIEVABLE[1]
    return dataclasses.replace(info, clock="device" if believable else "wall"), found
