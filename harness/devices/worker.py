"""What the process that holds a device does: it knows programs and buffers only, no plugins, surfaces or files.

Whatever a driver does to it, the runner on the other end of the pipe sees an answer, a closed pipe or silence.
"""

from __future__ import annotations

import time
from collections import OrderedDict
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Casts, DeviceInfo, FirsthitError, Hits, Program
from harness.devices import lanes
from harness.devices.frames import Batch, Picture, Rasteriser
from harness.devices.interface import (
    Array,
    Device,
    Launch,
    Timing,
    find_devices,
    hits_from,
    launch_camera,
    launch_rays,
    open_device,
    same_values,
)
from harness.devices.quadtree import (
    BY_DEVICE,
    Layout,
    beam_hits_from,
    last_level,
    launch_beams,
    launch_narrowed_camera,
    launch_narrowed_rays,
    start_of,
)
from harness.devices.trial import trial_launch

ENOUGH_MS = 2.0  # a sample lasts at least about this long; shorter launches are repeated within it
MOST_REPEATS = 64
WARM_MS = 200.0  # a launch that takes longer has warmed the device up by itself
KEPT_PROGRAMS = 128  # built ones: a surface's views run the same programs, one view after the other


@dataclass(frozen=True, eq=False)
class Frame:
    """What is timed: a program over a camera's image, or over listed rays where `rays` are given."""

    program: Program
    camera: NDArray[np.float32]  # [12]
    rays: NDArray[np.float32] | None  # [size * size, 6]
    size: int  # samples per side
    casts: Casts = "rays"
    prepass: Program | None = None  # whose beams narrow the rays
    batches: tuple[Batch, ...] = ()  # of a frame that is rasterised, in order; `program` is the first one's, or
    # for the check the one that reports all pixels' rays
    depth_map: tuple[float, float] = (0.0, 0.0)  # a, b of its depth buffer's a + b / s
    layout: Layout = BY_DEVICE  # of beams


@dataclass(frozen=True, eq=False)
class Checked:
    """Hits on the accuracy rays, and what building cost; for beams also what the whole frame says of them."""

    hits: Hits
    compile_ms: float
    levels: NDArray[np.uint8] | None = None  # [n] of the quadtree, at which each ray's pixel was decided
    evaluations: tuple[float | None, int] | None = None  # mean and largest over the frame's pixels, as Hits.spent
    prepass_evaluations: float | None = None  # the prepass's own, mean over the frame's pixels
    lanes: list[dict[str, Any]] | None = None  # of beams: what each level's work items spend, as lanes.summary


@dataclass(frozen=True, eq=False)
class Rasterised:
    """What a frame whose programs report answered, and what building them cost."""

    picture: Picture
    compile_ms: float


@dataclass(frozen=True)
class Warmed:
    """What the frame cost apart from running, and how often it is repeated within one sample."""

    compile_ms: float
    upload_ms: float
    readback_ms: float
    batch: int
    bytes: int | None = None  # of instances, triangles and vertices that a rasterised frame keeps on the device


class Worker:
    def __init__(self, name: str) -> None:
        self._name = name
        self._frames: dict[str, Launch] = {}
        self._built: OrderedDict[str, tuple[Any, float]] = OrderedDict()  # by hash; the first is the longest unused

    @cached_property
    def _device(self) -> Device:
        return open_device(self._name)

    def find(self) -> list[DeviceInfo]:
        """The devices of the backend this worker is named after."""
        return find_devices(self._name)

    def probe(self) -> Any:
        from harness.devices.probes import probe

        return probe(self._device)

    def build(self, program: Program) -> float:
        """The milliseconds that compiling took, what the driver leaves to the first launch included."""
        return self._build(program)[1]

    def _build(self, program: Program) -> tuple[Any, float]:
        """The built program, and the milliseconds that compiling it took, now or when this worker first did."""
        if program.hash not in self._built:
            start = time.perf_counter()
            built = self._device.build(program)
            compile_ms = (time.perf_counter() - start) * 1e3
            if not program.vertex:  # a rasterised program is drawn, not launched
                trial = trial_launch(self._device, program, built)
                compile_ms += trial.run().wall_ms
                trial.release()
            self._built[program.hash] = built, compile_ms
            if len(self._built) > KEPT_PROGRAMS:
                self._built.popitem(last=False)
        self._built.move_to_end(program.hash)
        return self._built[program.hash]

    def check(self, program: Program, rays: NDArray[np.float32]) -> Checked:
        """Build a listed-rays program and run it twice; rays: float32[n, 6]. A FirsthitError where answers differ."""
        built, compile_ms = self._build(program)
        outputs, again = _twice(launch_rays(self._device, program, built, rays))
        hits = hits_from(outputs)
        _need_same(hits, hits_from(again))
        return Checked(hits, compile_ms)

    def check_frame(self, frame: Frame, pixels: NDArray[np.int32]) -> Checked:
        """Build a frame of beams and run it twice; what it answers for `pixels`, int32[n], or, where beams are only the
        prepass, for the rays of the frame, float32[n, 6], which lie in those pixels. A FirsthitError where the two
        runs answer differently."""
        built, compile_ms = self._build(frame.program)
        if frame.prepass:
            assert frame.rays is not None
            before, more_ms = self._build(frame.prepass)
            programs = frame.prepass, frame.program
            launch = launch_narrowed_rays(
                self._device, programs, (before, built), frame.camera, frame.size, frame.rays, pixels
            )
            (*outputs, spent), (*again, _) = _twice(launch)
            hits = hits_from(outputs)
            _need_same(hits, hits_from(again))
            return Checked(hits, compile_ms + more_ms, prepass_evaluations=float(spent.sum()) / frame.size**2)
        quadtree = frame.casts == "quadtree"
        launch = launch_beams(
            self._device,
            frame.program,
            built,
            frame.camera,
            frame.size,
            quadtree,
            frame.layout,
            blank=True,
            queues=True,
        )
        outputs, again = _twice(launch)
        hits, levels = beam_hits_from(outputs)
        _need_same(hits, beam_hits_from(again)[0])
        picked = Hits(hits.t[pixels], hits.status[pixels], hits.evaluations[pixels])
        start = start_of(self._device.info, frame.size, quadtree, frame.layout)
        tree = lanes.Tree(frame.size, start, last_level(frame.size), frame.layout.grouped)
        return Checked(
            picked, compile_ms, levels[pixels], hits.spent, lanes=lanes.of_frame(tree, hits, levels, outputs)
        )

    def rasterise(self, frame: Frame, twice: bool) -> Rasterised:
        """Draw a frame of reporting programs; `twice`: a FirsthitError where two pictures of it differ."""
        built = [self._build(batch.program) for batch in frame.batches]
        pictures: list[Picture] = []
        for _ in range(1 + twice):
            launch = self._raster(frame, self._build(frame.program)[0])  # anew: its counts add up from run to run
            launch.run()
            pictures.append(launch.picture())
            launch.release()
        _need_steady(pictures[0].differing(pictures[-1]), "pixels")
        return Rasterised(pictures[0], sum(compile_ms for _, compile_ms in built))

    def _raster(self, frame: Frame, fill: Any = None) -> Any:
        programs = [self._build(batch.program)[0] for batch in frame.batches]
        if not isinstance(self._device, Rasteriser):
            raise FirsthitError(f"{self._name} draws no triangles")
        return self._device.launch_raster(frame.batches, programs, frame.camera, frame.depth_map, frame.size, fill)

    def _launch(self, frame: Frame, built: Any) -> Launch:
        if frame.batches:
            launch: Launch = self._raster(frame)
            return launch
        if frame.prepass:
            before, _ = self._build(frame.prepass)
            programs = frame.prepass, frame.program
            return launch_narrowed_camera(self._device, programs, (before, built), frame.camera, frame.size)
        if frame.casts != "rays":
            quadtree = frame.casts == "quadtree"
            return launch_beams(self._device, frame.program, built, frame.camera, frame.size, quadtree, frame.layout)
        if frame.rays is None:
            return launch_camera(self._device, frame.program, built, frame.camera, frame.size)
        return launch_rays(self._device, frame.program, built, frame.rays)

    def warm(self, key: str, frame: Frame) -> Warmed:
        """Build and upload a frame, run it until warm, read it back once, and keep it ready under `key`."""
        built, compile_ms = self._build(frame.program)
        compile_ms += self._build(frame.prepass)[1] if frame.prepass else 0.0
        compile_ms += sum(
            self._build(program)[1] for program in {b.program.hash: b.program for b in frame.batches[1:]}.values()
        )
        launch = self._launch(frame, built)
        duration = launch.run().wall_ms
        if duration < WARM_MS:
            duration = launch.run().wall_ms
        start = time.perf_counter()
        launch.read()
        readback_ms = (time.perf_counter() - start) * 1e3
        self._frames[key] = launch
        batch = min(MOST_REPEATS, max(1, round(ENOUGH_MS / max(duration, 1e-6))))
        return Warmed(compile_ms, launch.upload_ms, readback_ms, batch, getattr(launch, "bytes", None))

    def sample(self, key: str, batch: int) -> Timing:
        return self._frames[key].run(batch)

    def release(self, key: str) -> None:
        if frame := self._frames.pop(key, None):
            frame.release()


def _twice(launch: Launch) -> tuple[list[Array], list[Array]]:
    """The outputs of two runs of a launch, which is released."""
    launch.run()
    first = [output.copy() for output in launch.read()]
    launch.run()
    second = [output.copy() for output in launch.read()]
    launch.release()
    return first, second


def _need_same(hits: Hits, again: Hits) -> None:
    same = [same_values(values, getattr(again, name)) for name, values in vars(hits).items()]
    _need_steady(~np.logical_and.reduce(same), "rays")


def _need_steady(differs: NDArray[np.bool_], what: str) -> None:
    """Raise where the same program on the same input does not answer alike twice: then it has no answers."""
    if differs.any():
        message = f"two runs of the program answer {int(differs.sum())} of {len(differs)} {what} differently"
        raise FirsthitError(f"{message}: its kernel reads what nobody wrote, or the device is at fault", exit_code=3)
