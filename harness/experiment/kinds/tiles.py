"""Cast tiles: rays of a tile of pixels are isolated together, and each ray is finished by itself.

The check casts the very rays that the oracle certifies. It casts a frame of its own, whose pixels are as narrow as
those of the timed frame or narrower, and lie so that each ray of the accuracy grid goes through a pixel's middle. That
pixel is cast with the grid's ray, as it was made on the host; its tile is isolated with rays of the camera.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.answers import validated
from harness.accuracy.check import Cast
from harness.accuracy.compilers import SecondBuild
from harness.contract import FirsthitError, Hits, Program, Surface
from harness.devices.messages import Check, Frame
from harness.devices.steps import Executor
from harness.devices.tiles import TileAnswer, TileCheck, TileFrame, TileHits, TilePictures, plan_of
from harness.experiment.kinds.model import Asked, Casting, Kind, RacedCasting
from harness.experiment.kinds.programs import Programs
from harness.experiment.kinds.shots import Shot, ShotKind
from harness.kernels.assemble import Entry, Language
from harness.kernels.sections import with_free_loops
from harness.scenes.camera import rays_of

TIMED: tuple[Entry, ...] = ("isolate", "finish", "packets", "rest")
PICTURE = (
    15  # pixels a side of the picture about a hard ray: a tile of the first level, without its last row and column
)
BOUNDS = "fourths"  # the name among a casting's tables
CHECKED: tuple[Entry, ...] = ("isolate", "finish_listed", "packets_listed", "rest_listed")


class TileMethods(ShotKind):
    """State what follows for methods whose kernel isolates roots for tiles of pixels, and then casts their pixels."""

    what = "tiles"
    entries = tuple(dict.fromkeys((*TIMED, *CHECKED)))
    unlisted = "casts the tiles of a camera's image, and listed rays have none"
    undrawn = "casts the tiles of a camera's image, and fragments have none"
    shot_entries = CHECKED
    hard_entries = CHECKED
    answers_rays = True

    def hard_check(self, programs: tuple[Program, ...], surface: Surface, rays: NDArray[np.float32]) -> Check[Hits]:
        cameras = np.stack([camera_about(ray) for ray in rays])
        return TilePictures(frame_of(programs, surface, cameras[0], PICTURE), rays, cameras)

    def view_check(
        self,
        programs: tuple[Program, ...],
        surface: Surface,
        camera: NDArray[np.float32],
        rays: NDArray[np.float32],
        size: int,
    ) -> Check[Hits]:
        side = math.isqrt(len(rays))
        moved, ratio = checked_over(camera, side, size)
        return TileHits(TileCheck(frame_of(programs, surface, moved, ratio * side), rays, ratio, np.arange(len(rays))))

    def shot(self, programs: tuple[Program, ...], shot: Shot, index: NDArray[np.intp]) -> Check[TileAnswer]:
        assert shot.camera is not None
        frame = frame_of(programs, shot.surface, shot.camera, math.isqrt(len(shot.rays)))
        return TileCheck(frame, shot.rays, 1, index)

    def shot_hits(self, answer: TileAnswer) -> Hits:
        return answer.hits

    def validated(self, hits: Hits, surface: Surface, shot: Shot) -> Hits:
        return validated(hits, surface.domain, shot.rays, shot.t_min)


def bounds_for(isolate: Program, surface: Surface) -> NDArray[np.float64]:
    """Return the bounds of the surface's fourth derivatives that the programs of a frame read; [0] if they read none.

    Raises FirsthitError if the programs read bounds of the surface that there are none of, or of another grid.
    """
    from harness.kernels.fourths import GRID, fourth_pyramid

    grid = plan_of(isolate).grid
    if grid not in (0, GRID):
        raise FirsthitError(f"the programs read bounds over {grid} cells a side, and here {GRID} are made")
    return fourth_pyramid(surface) if grid else np.zeros(0)


def frame_of(
    stages: tuple[Program, ...],
    surface: Surface,
    camera: NDArray[np.float32],
    size: int,
    bounds: NDArray[np.float64] | None = None,
) -> TileFrame:
    """Return the frame of size x size pixels by the programs of `stages`, which are isolate, finish, packets and rest.

    `camera` is float32[12]. `bounds` are those that the programs' own revision makes; None for programs of this one.
    Raises FirsthitError as `bounds_for` does, and if the programs read bounds and there are none.
    """
    isolate, finish, packets, rest = stages
    grid = plan_of(isolate).grid
    handed = bounds_for(isolate, surface) if bounds is None else bounds
    if grid and not handed.size:
        raise FirsthitError(f"the programs read bounds over {grid} cells a side, and none are handed to them")
    return TileFrame((isolate, finish, packets, rest), camera, size, handed)


def camera_about(ray: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the camera float32[12] of a picture of PICTURE x PICTURE pixels, whose middle pixel has the ray.

    `ray` is float32[6]. The pixels are as wide as in an image of 30 degrees and 1024 pixels.
    """
    eye, forward = np.split(ray.astype(np.float64), 2)
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, np.eye(3)[np.argmin(np.abs(forward))])
    right *= PICTURE * math.tan(math.radians(15.0)) / 1024 / np.linalg.norm(right)
    return np.concatenate([eye, forward, right, np.cross(right, forward)]).astype(np.float32)


def checked_over(camera: NDArray[np.float32], rays_per_side: int, size: int) -> tuple[NDArray[np.float32], int]:
    """Return the camera float32[12] and the ratio of the frame in which a grid's rays are checked.

    The frame has `ratio` pixels a side for each ray of rays_of(camera, rays_per_side), and at least as many as one of
    size x size pixels. If the ratio is even, its camera looks half a pixel to the right and down, so that the grid's
    rays go through middles of pixels.
    """
    ratio = -(-size // rays_per_side)
    if ratio % 2:
        return camera, ratio
    eye, forward, right, up = camera.astype(np.float64).reshape(4, 3)
    moved = forward + (right - up) / (ratio * rays_per_side)
    return np.concatenate([eye, moved, right, up]).astype(np.float32), ratio


class TileCasting(RacedCasting):
    """Cast the tiles of a camera's image."""

    def __init__(
        self,
        asked: Asked,
        checks: tuple[Program, ...],
        timed: tuple[Program, ...],
        bounds: NDArray[np.float64] | None = None,
    ) -> None:
        """Take the programs of CHECKED, those of TIMED and, if these are another revision's, the bounds it made."""
        super().__init__(asked, checks, timed[0])
        self.further, self.bounds = timed[1:], bounds

    @property
    def others(self) -> tuple[Program, ...]:
        return self.further

    def frame(self) -> Frame | None:
        assert self.timed
        return self._frame((self.timed, *self.further), self.camera, self.samples)

    def _frame(self, stages: tuple[Program, ...], camera: NDArray[np.float32], size: int) -> TileFrame:
        return frame_of(stages, self.cell.surface, camera, size, self.bounds)

    @property
    def tables(self) -> Mapping[str, NDArray[np.float64]]:
        assert self.timed
        if self.bounds is not None:
            return {BOUNDS: self.bounds}
        try:
            return {BOUNDS: bounds_for(self.timed, self.cell.surface)}
        except FirsthitError:  # which fails the cell where it is cast, with this reason
            return {}

    def cast(self, executor: Executor, size: int, free_loops: bool = False) -> Cast:
        surface, rays = self.cell.surface, rays_of(self.camera, size)
        programs = tuple(with_free_loops(program) if free_loops else program for program in self.checks)
        camera, ratio = checked_over(self.camera, size, self.samples)
        frame = self._frame(programs, camera, ratio * size)
        checked = executor.check(self.cell.device, TileCheck(frame, rays, ratio, np.arange(len(rays))))
        answer = checked.answer
        hits = validated(answer.hits, surface.domain, rays)
        mean, largest = answer.evaluations  # over all pixels of the check's frame, which share their tiles' evaluations
        facts = {"evaluations_mean": mean, "evaluations_max": largest, "stages": answer.shares}
        pictures = {"stage": answer.stages.reshape(size, size)}
        return Cast(surface, rays, hits, checked.compile_ms, facts, pictures)

    def second_build(self, executor: Executor, cast: Cast) -> SecondBuild | None:
        if self.bounds is not None:
            return None
        cell, size = self.cell, math.isqrt(len(cast.rays))

        def programs(language: Language) -> tuple[Program, ...]:
            return tuple(self.asked.program(cell.surface, entry, language) for entry in CHECKED)

        def run(device: str, programs: tuple[Program, ...], index: NDArray[np.intp]) -> Hits:
            frame = frame_of(programs, cell.surface, self.camera, size)
            return executor.check(device, TileCheck(frame, cast.rays, 1, index)).answer.hits

        return SecondBuild(cell.device, cell.precision, programs, run)

    def with_programs(self, programs: Programs) -> RacedCasting:
        if not programs.timed or len(programs.others) != len(self.further):
            raise FirsthitError("that revision's frame of tiles has other stages")
        if BOUNDS not in programs.tables:
            raise FirsthitError("that revision does not tell its bounds of the surface's fourth derivatives")
        return TileCasting(self.asked, programs.checks, (programs.timed, *programs.others), programs.tables[BOUNDS])


@dataclass(frozen=True)
class Tiles(Kind):
    """Make castings of tiles, in stage compute."""

    def unable(self, asked: Asked) -> str | None:
        method = asked.method
        return None if method.rest else f"the method {method.name} states no `rest`, which casts what no tile decides"

    def casting(self, asked: Asked) -> Casting:
        surface = asked.cell.surface
        checks = tuple(asked.program(surface, entry) for entry in CHECKED)
        timed = tuple(asked.freed(asked.program(surface, entry)) for entry in TIMED)
        return TileCasting(asked, checks, timed)
