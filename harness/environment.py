"""Where a run took place: versions, commit, machine, and its devices as their probes found them."""

from __future__ import annotations

import dataclasses
import platform
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from harness import __version__, plan
from harness.contract import DeviceInfo
from harness.executor import CellError, LocalExecutor

ROOT = Path(__file__).parent.parent
PACKAGES = ("numpy", "sympy", "python-flint", "moderngl", "pyopencl")


def _git(*arguments: str) -> str | None:
    try:
        result = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=False)
    except OSError:
        return None
    return result.stdout.strip() if result.returncode == 0 else None


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
        "commit": _git("rev-parse", "--short=12", "HEAD"),
        "dirty": bool(_git("status", "--porcelain", "--untracked-files=no")),
        "python": platform.python_version(),
        "platform": platform.platform(),
        "cpu": plan.processor(),
        "versions": versions,
    }


def probed(executor: LocalExecutor, info: DeviceInfo) -> tuple[DeviceInfo, dict[str, Any]]:
    """The device with the clock that its probes support, and what they found."""
    if info.problem:
        return info, {}
    try:
        probes = executor.probe(info.name)
    except CellError as error:
        return dataclasses.replace(info, problem=f"its probes failed: {error}"), {}
    clock = "device" if probes.clock_believable else "wall"
    return dataclasses.replace(info, clock=clock), dataclasses.asdict(probes)
