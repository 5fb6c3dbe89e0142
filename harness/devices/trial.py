"""A launch over a single item that meets nothing: many drivers leave most of compiling to the first launch."""

from __future__ import annotations

from typing import Any

import numpy as np

from harness.contract import Program
from harness.devices.interface import Array, Device, Launch, Reserved, Step, real_type
from harness.devices.quadtree import LEVELS, PARENT

AWAY = (0.0, 0.0, 1024.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0)  # a camera: eye, forward, right, up


def trial_launch(device: Device, program: Program, built: Any) -> Launch:
    """One ray, pixel or cell of any method's program."""
    kind = real_type(program)
    camera, ray = np.array(AWAY, np.float32), np.array(AWAY[:6], np.float32)
    answer = [Reserved(2, kind), Reserved(1, np.int32)]
    numbers: dict[str, int] = {}
    buffers: list[Array | Reserved] = [camera, *answer]
    if program.entry == "beams":
        buffers += [Reserved(PARENT, np.int32), Reserved(LEVELS, np.int32)]
        numbers = {"size": 1, "level": -1, "last": 0, "source": -1, "target": 0}
    elif program.sections[-1].origin.rpartition(".")[0].endswith("_narrowed"):
        buffers += [np.zeros(2, kind)]
        buffers += [ray, np.zeros(1, np.int32)] if program.entry == "rays" else []
    elif program.entry == "rays":
        buffers = [ray, *answer]
    return device.launch_steps(buffers, (), [Step(built, tuple(range(len(buffers))), (1, 1), numbers)])
