"""Tell of the machine that holds the devices: its processor, and the environment variables that drivers read."""

from __future__ import annotations

import os
import platform
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from harness.hosting.cores import cores as cores  # a software device has no more

# How the names of variables begin that drivers and compilers read
SETTINGS = ("CL_CONFIG_", "POCL_", "LP_", "GALLIVM_", "GALLIUM_", "MESA_", "CUDA_", "__GL_")
# As harness/devices sets them if the user does not
OURS = {"POCL_KERNEL_CACHE": "0", "CL_CONFIG_CPU_VECTORIZER_MODE": "16", "MESA_SHADER_CACHE_DISABLE": "true"}


@cache
def processor() -> str:
    """Return the processor's name, since software devices are only as fast as it."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
        return next(line.split(":", 1)[1].strip() for line in text.splitlines() if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def settings() -> dict[str, str]:
    """Return the variables by which a user changes drivers and compilers, without those that the harness sets."""
    chosen = {name: value for name, value in os.environ.items() if name.startswith(SETTINGS)}
    return {name: value for name, value in sorted(chosen.items()) if OURS.get(name) != value}


@dataclass(frozen=True, eq=False)
class Host:
    """Hold what of the machine that holds a device decides what is found there: see processor, cores and settings."""

    processor: str
    cores: int | None
    settings: Mapping[str, str]


def this_host() -> Host:
    """Return what is so of this machine, for this process."""
    return Host(processor(), cores(), settings())
