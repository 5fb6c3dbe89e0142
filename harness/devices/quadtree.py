"""Launch programs that cast beams: over the cells of a quadtree over the image, level by level, queued on the device.

The host says once which levels there are; nothing comes back to it between them. Each level's work items stride over as
many cells as its queue turns out to hold.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.contract import DeviceInfo, Hits, Program
from harness.devices.interface import Array, Built, Device, Launch, Reserved, Step, real_type, unpacked

UNITS = 64  # compute units of a device that does not say how many it has
CELLS_PER_UNIT = 64  # how many fill a unit that does not say what it holds: one work group
ITEMS_PER_UNIT = 2048  # work items that a queue is strided over, at most
MOST_ITEMS = 2**21  # work items of any level: OpenGL promises 65535 groups
LEVELS = (
    32  # counters: for each of 16 levels the cells that it queues, then for each those that it puts after the others
)
PARENT = 3  # int32 in the queue for each cell
ALL, ALL_IN_ROWS = -1, -2  # instead of a place in the queue: every cell of the level, in Z order or row by row


@dataclass(frozen=True)
class Layout:
    """Say how cells are laid over levels and work items, which a method's knobs decide and the launch reads.

    first: the quadtree's first level; None: the one that fills the device
    grouped: a level of which all cells are searched is taken in Z order; False: row by row
    """

    first: int | None = None
    grouped: bool = True


BY_DEVICE = Layout()


def layout_of(knobs: Mapping[str, float | int]) -> Layout:
    """Return the layout that a method's knobs ask for.

    FIRST_LEVEL is the first level, negative if the device is to decide; GROUPED is as in Layout. A method need not have
    them.
    """
    first = int(knobs.get("FIRST_LEVEL", -1))
    return Layout(None if first < 0 else first, bool(knobs.get("GROUPED", 1)))


def last_level(size: int) -> int:
    """Return the quadtree's level whose cells are the pixels of a size × size image."""
    return max(0, (size - 1).bit_length())


def first_level(info: DeviceInfo, last: int) -> int:
    """Return the first level with enough cells to fill the device (beamcasting, III.E), or `last` if none has."""
    cells = (info.resident or CELLS_PER_UNIT) * (info.compute_units or UNITS)
    return min(last, -(-(cells - 1).bit_length() // 2))


def most_queued(size: int, level: int, last: int) -> int:
    """Count the cells of `level` in a size × size image whose pixels are level `last`: the most that it can queue."""
    return int((-(-size // 2 ** (last - level))) ** 2)


def quadtree_steps(
    device: Device, built: Built, size: int, first: int, last: int, stop: int, grouped: bool = True
) -> tuple[list[Step], int]:
    """Return the steps of levels `first` to `stop` of a quadtree, and the count of int32 that its queue takes.

    Level `last` has the pixels. Buffers 0 to 4 must be camera, two outputs, queue and counts. `grouped` is as in
    Layout.
    """
    most = min(MOST_ITEMS, ITEMS_PER_UNIT * max(UNITS, device.info.compute_units or 0))
    buffers = (0, 1, 2, 3, 4)
    source, target = ALL if grouped else ALL_IN_ROWS, 0
    fixed = {"size": size, "level": -1, "last": last, "source": source, "target": 0}
    steps = [Step(built, buffers, (LEVELS, 1), fixed)] if stop > first else []
    for level in range(first, stop + 1):
        items = min(4**level, MOST_ITEMS if source < 0 else most)
        numbers = fixed | {"level": level, "source": source, "target": target}
        steps.append(Step(built, buffers, (items, 1), numbers))
        if level < stop:
            source, target = target, target + PARENT * most_queued(size, level, last)
    return steps, target


def launch_beams(
    device: Device,
    program: Program,
    built: Built,
    camera: NDArray[np.float32],
    size: int,
    quadtree: bool,
    layout: Layout = BY_DEVICE,
    blank: bool = False,
    queues: bool = False,
) -> Launch:
    """Launch a beam for each pixel of a size × size image, or a quadtree of beams from the layout's first level.

    `camera` is float32[12]. With `blank` a pixel that no cell answers reads as one without an answer. Outputs: t and
    answer of each pixel, for beam_hits_from; with `queues` also the queue and its counts, for lanes.spent_by_items.
    """
    last = last_level(size)
    start = start_of(device.info, size, quadtree, layout)
    steps, queue = quadtree_steps(device, built, size, start, last, last, layout.grouped)
    buffers: list[Array | Reserved] = [
        np.ascontiguousarray(camera, np.float32),
        Reserved(size * size, real_type(program)),
        Reserved(size * size, np.int32, fill=-1 if blank else None),
        Reserved(queue, np.int32),
        Reserved(LEVELS, np.int32),
    ]
    return device.launch_steps(buffers, (1, 2, 3, 4) if queues else (1, 2), steps)


def start_of(info: DeviceInfo, size: int, quadtree: bool, layout: Layout) -> int:
    """Return the first level that is searched: the pixels' own without a quadtree, and never a deeper one."""
    last = last_level(size)
    if not quadtree:
        return last
    return first_level(info, last) if layout.first is None else min(last, layout.first)


def beam_hits_from(outputs: Sequence[Array]) -> tuple[Hits, NDArray[np.uint8]]:
    """Read what a launch of beams answered for n pixels.

    Returns the hits, and uint8[n], the quadtree's level at which each pixel's cell was eliminated or hit. t is along
    the ray through the pixel's middle. A shared beam's evaluations are divided among its pixels, so that they add up to
    what was spent.
    """
    t, answer = outputs[:2]
    hits = unpacked(t, answer, answer & 3, answer >> 7)
    return hits, ((answer >> 2) & 31).astype(np.uint8)
