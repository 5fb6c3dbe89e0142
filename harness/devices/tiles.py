"""Launch frames of tiles: stages that isolate roots for tiles of pixels, and cast the pixels of these tiles.

A frame is a list of steps, between which nothing comes back to the host. Each stage is a program of its own, and takes
its work from counters on the device until there is none.

    step            program  what it does
    --------------  -------  -------------------------------------------------------------------
    clear           isolate  sets the counters to 0
    isolate, level  isolate  tiles of a level: each is empty, has a single root, or is left open
    finish, level   finish   pixels of the level's tiles with a single root
    packets         packets  pixels of the last level's open tiles
    rest            rest     pixels that no other stage has answered, each by itself
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from harness.contract import Hits, Program, RayStatus
from harness.devices.interface import (
    Array,
    Built,
    Device,
    Launch,
    Reserved,
    Step,
    StepLaunch,
    real_type,
    same_values,
    unpacked,
)
from harness.devices.messages import Check, FirstRun, Frame, HitsCheck, need_steady
from harness.devices.quadtree import ITEMS_PER_UNIT, MOST_ITEMS, UNITS
from harness.kernels.sections import TileStage

T, ANSWER = 1, 2  # places of outputs among BUFFERS
NO_ANSWER = -1  # what a pixel reads as that no stage answers, or not validly
COUNTS = 64  # counters
RESIDENT = 4096  # work items of a step for each compute unit of a GPU: twice what it holds at once
GROUPS_PER_UNIT = 32  # work groups that take tiles, for each compute unit of a processor
BUFFERS = (0, 1, 2, 3, 4, 5, 6, 7)  # camera, t, answer, queue, counts, entries, fourths, rays: of each step
TILE_STAGES = get_args(TileStage)
UNREAD = np.zeros(6, np.float32)  # what a frame has in the place of listed rays


@dataclass(frozen=True)
class Plan:
    """State what a program of tiles says of the frame that it is for. The host lays buffers and steps out by it.

    side: pixels a side of the first level's tiles; each level's are half as wide as those before
    levels: how many levels there are
    grid: cells a side of the table of bounds; 0: it reads none
    queued: int32 in the queue for each tile, beside one for each pixel
    kept: reals in the entries for each tile, beside one for each pixel
    items: work items that share a tile, or in stage rest a pixel
    group: work items of a work group; 1: a processor's, of which few run at once
    turns: tiles or pixels that each work item is to take one after the other
    parts: of a tile in stage finish, each taken by itself
    opened: whether stage packets leaves pixels of open tiles to stage rest
    """

    side: int
    levels: int
    grid: int
    queued: int
    kept: int
    items: int
    group: int
    turns: int
    parts: int
    opened: bool

    @property
    def sides(self) -> list[int]:
        """Return the pixels a side of each level's tiles."""
        return [self.side >> level for level in range(self.levels)]

    @property
    def stages(self) -> list[str]:
        """Name the ways in which a pixel is answered, by the number that its answer holds."""
        told = [f"{verdict}_{side}" for verdict in ("empty", "single") for side in self.sides]
        return [*told, "packets", "rest"]


def plan_of(program: Program) -> Plan:
    """Read the plan that a program was made with, which another revision's may have chosen otherwise."""

    def told(name: str, otherwise: str = "") -> int:
        _, _, after = program.text.partition(f"#define {name} ")
        return int((after or otherwise).split()[0])

    kept = told("OPEN_RECORD") + told("SINGLE_RECORD")
    shape = told("TILE"), told("LEVELS"), told("GRID")
    items = told("TILE_ITEMS"), told("TILE_GROUP"), told("TILE_TURNS"), told("FINISH_PARTS", otherwise="1")
    return Plan(*shape, told("QUEUE_RECORD"), kept, *items, told("OPEN_TILES", otherwise="0") == 1)


def tiles(size: int, side: int) -> int:
    """Count the tiles of side x side pixels that cover an image of size x size pixels; some may reach out of it."""
    return int((-(-size // side)) ** 2)


def tile_steps(device: Device, plans: Sequence[Plan], built: Sequence[Built], size: int, ratio: int) -> list[Step]:
    """Return a frame's steps; `plans` and `built` are of its programs isolate, finish, packets and rest.

    Each step has all BUFFERS. `ratio` is as in TileCheck, 1 for a frame that is timed.
    """
    isolate, finish, packets, rest = zip(plans, built, strict=True)
    units, plan = device.info.compute_units or UNITS, plans[0]

    def step(stage: tuple[Plan, Built], tile: int, level: int, pieces: int) -> Step:
        own, program = stage
        numbers = {"size": size, "tile": tile, "level": level, "ratio": ratio}
        most = GROUPS_PER_UNIT * units if own.group == 1 else RESIDENT * units if device.info.resident else MOST_ITEMS
        return Step(program, BUFFERS, (min(-(-own.items * pieces // own.turns), most), 1), numbers, own.group)

    by_level = [(level, side, tiles(size, side)) for level, side in enumerate(plan.sides)]
    last = plan.sides[-1]
    steps = [replace(step(isolate, plan.side, -1, 1), grid=(COUNTS, 1))]
    steps += [step(isolate, side, level, count) for level, side, count in by_level]
    steps += [
        step(finish, side, level, max(1, min(plan.parts, side**2 // 16)) * count) for level, side, count in by_level
    ]
    if not plan.opened:
        steps.append(step(packets, last, plan.levels, tiles(size, last)))
    cast = step(rest, last, plan.levels + 1, size * size)
    if plans[3].group > 1 and device.info.resident:
        return [*steps, cast]
    if plans[3].group > 1:  # most frames leave few pixels, and a processor takes long to begin an item for each
        return [*steps, replace(cast, grid=(min(size * size, GROUPS_PER_UNIT * units * plans[3].group), 1))]
    items = min(size * size, ITEMS_PER_UNIT * max(UNITS, units))
    return [*steps, replace(cast, grid=(items, 1), group=None)]


@dataclass(frozen=True, eq=False)
class TileFrame(Frame):
    """State a frame of tiles over a camera's image.

    stages: the programs isolate, finish, packets and rest
    camera: float32[12] (eye, forward, right, up); forward may be moved aside by less than a pixel
    size: pixels per side
    fourths: bounds of f's fourth derivatives, as harness.kernels.fourths makes them; [0] if the plan has no grid
    """

    stages: tuple[Program, Program, Program, Program]
    camera: NDArray[np.float32]
    size: int
    fourths: NDArray[np.float64]

    @property
    def programs(self) -> tuple[Program, ...]:
        return self.stages

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        return launch_tiles(device, self, built, UNREAD, 1)


@dataclass(frozen=True, eq=False)
class TileAnswer:
    """Hold what a frame of tiles answered for n chosen pixels, and what it spent on all of its pixels.

    hits: [n], t along the listed rays
    stages: uint8[n], the number in Plan.stages of what answered each pixel
    evaluations: mean and largest number over the frame's pixels, as Hits.spent returns them
    shares: of the frame's answered pixels that each stage answered, by the stage's name; all 0 if none is answered
    """

    hits: Hits
    stages: NDArray[np.uint8]
    evaluations: tuple[float | None, int]
    shares: dict[str, float]


@dataclass(frozen=True, eq=False)
class TileCheck(HitsCheck[TileAnswer]):
    """State a check that casts a frame of tiles, some of whose pixels have listed rays, and reads answers of these.

    frame: of programs that take listed rays; its size is a multiple of `ratio`
    rays: float32[k * k, 6], through the middles of each ratio-th pixel of each ratio-th row
    ratio: pixels a side for each listed ray
    index: int[n], which of the listed rays are read
    """

    frame: TileFrame
    rays: NDArray[np.float32]
    ratio: int
    index: NDArray[np.intp]

    @property
    def programs(self) -> tuple[Program, ...]:
        return self.frame.stages

    @property
    def pixels(self) -> NDArray[np.intp]:
        """Return the numbers of the pixels with the rays `index`: int[n]."""
        row, column = np.divmod(self.index, self.frame.size // self.ratio)
        middle = (self.ratio - 1) // 2
        return np.asarray((self.ratio * row + middle) * self.frame.size + self.ratio * column + middle)

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        return launch_tiles(device, self.frame, built, np.ascontiguousarray(self.rays, np.float32), self.ratio)

    def hits(self, outputs: Sequence[Array]) -> Hits:
        return tile_hits_from(outputs)[0]

    def answer(self, first: FirstRun) -> TileAnswer:
        pixels, hits = self.pixels, first.hits
        _, stages = tile_hits_from(first.outputs)
        names = plan_of(self.frame.stages[0]).stages
        counts = np.bincount(stages[hits.status != RayStatus.INVALID], minlength=len(names))
        shares = {name: float(counts[stage] / max(1, counts.sum())) for stage, name in enumerate(names)}
        picked = Hits(hits.t[pixels], hits.status[pixels], hits.evaluations[pixels])
        return TileAnswer(picked, stages[pixels], hits.spent, shares)


@dataclass(frozen=True, eq=False)
class TileHits(Check[Hits]):
    """State what a check of listed rays does, and read no more than their hits."""

    whole: TileCheck

    @property
    def programs(self) -> tuple[Program, ...]:
        return self.whole.programs

    def run(self, device: Device, built: Sequence[Built]) -> Hits:
        return self.whole.run(device, built).hits


@dataclass(frozen=True, eq=False)
class TilePictures(Check[Hits]):
    """State a check that casts listed rays, each in the middle of a small frame of its own, one after the other.

    frame: of programs that take listed rays; it has an odd number of pixels a side, and its camera is not looked at
    rays: float32[n, 6]
    cameras: float32[n, 12], of each ray's frame, whose middle the ray goes through
    """

    frame: TileFrame
    rays: NDArray[np.float32]
    cameras: NDArray[np.float32]

    @property
    def programs(self) -> tuple[Program, ...]:
        return self.frame.stages

    def run(self, device: Device, built: Sequence[Built]) -> Hits:
        launch = launch_tiles(device, self.frame, built, np.zeros(6, np.float32), self.frame.size)
        first, again = (self._cast(launch) for _ in range(2))
        launch.release()
        same = [same_values(values, getattr(again, name)) for name, values in vars(first).items()]
        need_steady(~np.logical_and.reduce(same), "rays")
        return first

    def _cast(self, launch: StepLaunch) -> Hits:
        """Cast each ray, and return its hit: [n]."""
        blank, hits = np.full(self.frame.size**2, NO_ANSWER, np.int32), list[Hits]()
        for camera, ray in zip(self.cameras, self.rays, strict=True):
            launch.write(BUFFERS[0], camera)
            launch.write(ANSWER, blank)
            launch.write(BUFFERS[-1], ray)
            launch.run()
            hits.append(tile_hits_from(launch.read())[0])
        middle = len(blank) // 2
        return Hits(*(np.array([getattr(one, name)[middle] for one in hits]) for name in vars(hits[0])))


def launch_tiles(
    device: Device, frame: TileFrame, built: Sequence[Built], rays: NDArray[np.float32], ratio: int
) -> StepLaunch:
    """Launch a frame whose programs are `built`. Outputs: t and answer of each pixel, for tile_hits_from.

    rays, ratio: as in TileCheck, where the programs take listed rays. A pixel that no stage answers then reads as one
    without an answer.
    """
    plans, real = [plan_of(program) for program in frame.stages], real_type(frame.stages[0])
    plan, pixels, listed = plans[0], frame.size**2, rays is not UNREAD
    covering = sum(tiles(frame.size, side) for side in plan.sides)
    buffers: list[Array | Reserved] = [
        np.ascontiguousarray(frame.camera, np.float32),
        Reserved(2 * pixels if listed else pixels, real),
        Reserved(pixels, np.int32, fill=NO_ANSWER if listed else None),
        Reserved(plan.queued * covering + pixels, np.int32),
        Reserved(COUNTS, np.int32),
        Reserved(plan.kept * covering + pixels, real),
        np.ascontiguousarray(frame.fourths, real).ravel() if plan.grid else np.zeros(1, real),
        rays,
    ]
    return device.launch_steps(buffers, (T, ANSWER), tile_steps(device, plans, built, frame.size, ratio))


def tile_hits_from(outputs: Sequence[Array]) -> tuple[Hits, NDArray[np.uint8]]:
    """Read what a launch of tiles answered for n pixels: the hits, and uint8[n], the number of what answered each.

    t of a program that takes listed rays comes in two parts, which are added in float64. A tile's evaluations are
    divided among its pixels.
    """
    t, answer = outputs
    with np.errstate(invalid="ignore", over="ignore"):  # t of a pixel without a hit is whatever lay in the buffer
        whole = t.astype(np.float64).reshape(len(answer), -1).sum(axis=1)
    hits = unpacked(whole, answer, answer & 3, answer >> 7)
    return hits, ((answer >> 2) & 31).astype(np.uint8)
