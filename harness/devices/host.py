"""The machine that devices are of: its processor, and the environment variables that their drivers listen to."""

from __future__ import annotations

import os
import platform
from functools import cache
from pathlib import Path

SETTINGS = ("CL_CONFIG_", "POCL_", "LP_", "GALLIVM_", "MESA_", "CUDA_", "__GL_")  # what drivers and compilers listen to
OURS = {"POCL_KERNEL_CACHE": "0", "CL_CONFIG_CPU_VECTORIZER_MODE": "16", "MESA_SHADER_CACHE_DISABLE": "true"}
# as harness/devices sets them where the user does not


@cache
def processor() -> str:
    """The processor's name, since software devices are only as fast as it."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
        return next(line.split(":", 1)[1].strip() for line in text.splitlines() if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def cores() -> int | None:
    """How many of the processor's cores this process may use: software devices are only as fast as these together."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


def settings() -> dict[str, str]:
    """Environment variables by which a user turns drivers and compilers, without those that the harness sets."""
    chosen = {name: value for name, value in os.environ.items() if name.startswith(SETTINGS)}
    return {name: value for name, value in sorted(chosen.items()) if OURS.get(name) != value}
