"""Launch a program once over one item, when it is built: many drivers leave most of compiling to the first launch."""

from __future__ import annotations

import numpy as np

from harness.contract import FirsthitError, Program
from harness.devices.interface import Array, Built, Device, Launch, Reserved, Step, real_type
from harness.devices.quadtree import LEVELS, PARENT
from harness.devices.tiles import COUNTS, TILE_STAGES, plan_of

AWAY = (0.0, 0.0, 1024.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0)  # a camera: eye, forward, right, up


def trial_launch(device: Device, program: Program, built: Built) -> Launch:
    """Upload one ray, pixel or cell that meets no surface, for the program of any method.

    Raises FirsthitError for a program whose entry is not known here: its buffers are not known either.
    """
    kind = real_type(program)
    camera, ray = np.array(AWAY, np.float32), np.array(AWAY[:6], np.float32)
    narrowed = program.sections[-1].origin.rpartition(".")[0].endswith("_narrowed")
    answer: list[Array | Reserved] = [Reserved(2, kind), Reserved(1, np.int32)]
    span: Array = np.zeros(2, kind)
    numbers: dict[str, int] = {}
    group: int | None = None
    buffers: list[Array | Reserved]
    if program.entry == "rays":
        buffers = [camera, *answer, span, ray, np.zeros(1, np.int32)] if narrowed else [ray, *answer]
    elif program.entry == "camera":
        buffers = [camera, *answer, span] if narrowed else [camera, *answer]
    elif program.entry in TILE_STAGES:
        plan = plan_of(program)
        scratch = [
            Reserved(64, np.int32),
            Reserved(COUNTS, np.int32, fill=0),
            Reserved(256, kind, fill=0),
        ]
        buffers = [camera, *answer, *scratch, np.zeros(16 * plan.grid**3 + 1, kind), ray]
        group = None if program.entry == "rest" else plan.group
        level = {"packets": plan.levels, "rest": plan.levels + 1}.get(program.entry, 0)
        numbers = {"size": 1, "tile": plan.sides[-1] if level else plan.side, "level": level, "ratio": 1}
    elif program.entry == "draw":
        buffers = [camera, *answer, Reserved(3, np.float32)]
    elif program.entry == "beams":
        buffers = [camera, *answer, Reserved(PARENT, np.int32), Reserved(LEVELS, np.int32)]
        numbers = {"size": 1, "level": -1, "last": 0, "source": -1, "target": 0}
    else:
        here = "harness/devices/trial_launch.py"
        raise FirsthitError(f"{here} does not say how a {program.entry} program is launched", exit_code=3)
    return device.launch_steps(buffers, (), [Step(built, tuple(range(len(buffers))), (1, 1), numbers, group)])
