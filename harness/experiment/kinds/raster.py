"""Draw a scene's instances by rasterisation: proxies whose fragments cast rays, or meshes.

Rays are not made here. Each fragment makes the ray through its pixel's middle, and the check reads it back. The
accuracy grid is drawn as a picture of its own, by programs that write their rays. A pixel that no proxy covers is a
miss, since the rasteriser itself has answered it. Fragments are counted on the frame that is timed.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.check import Cast, Certified
from harness.accuracy.judge import Deviations, Verdicts
from harness.accuracy.scene_truth import Seen, hits_of, scene_truth
from harness.contract import FirsthitError, Program, Truth
from harness.devices.messages import Frame
from harness.devices.raster import Picture, RasterCheck, RasterFrame
from harness.devices.steps import Executor
from harness.experiment.cells import Cell
from harness.experiment.config import AccuracyChoice
from harness.experiment.kinds.draws import Draw, draws, identity, refusal, too_many
from harness.experiment.kinds.model import Asked, Casting, Kind, KindFacts, ViewCasting
from harness.experiment.kinds.narrowed import REFUSAL as NO_PREPASS
from harness.experiment.kinds.programs import Programs
from harness.experiment.targets import able
from harness.kernels.raster import fill_program
from harness.kernels.sections import with_free_loops
from harness.scenes.camera import camera_for
from harness.scenes.model import Scene, single
from harness.scenes.records import depth_map


@dataclass(frozen=True, eq=False)
class SceneCast(Cast):
    """Hold the picture of a scene. Its truth is, for each pixel, the first hit over all instances.

    alone: it shows one surface, in that surface's own coordinates
    """

    scene: Scene
    picture: Picture
    alone: bool

    def certified(self, folder: Path, margin: float) -> Seen:
        return scene_truth(self.scene, self.rays, self.picture, folder, margin)

    def judged(self, verdicts: Verdicts, certified: Certified) -> tuple[Verdicts, dict[str, int]]:
        assert isinstance(certified, Seen)
        other = certified.other_instance(self.picture) & verdicts.clear
        return verdicts, {"other_instance": int(other.sum())}

    def deviations(self, truth: Truth, verdicts: Verdicts) -> Deviations:
        if self.alone:
            return super().deviations(truth, verdicts)
        nothing = np.full(len(self.rays), np.nan)
        return Deviations(nothing, nothing)


class RasterCasting(ViewCasting):
    """Draw a scene by its draw calls."""

    not_raced = "stage raster's pictures are not raced"

    def __init__(self, asked: Asked, scene: Scene, drawn: tuple[Draw, ...]) -> None:
        super().__init__(asked, tuple(draw.check for draw in drawn), drawn[0].timed)
        self.scene, self.draws = scene, drawn

    @property
    def others(self) -> tuple[Program, ...]:
        return tuple(draw.timed for draw in self.draws)

    @property
    def methods(self) -> tuple[str, ...]:
        own = (draw.group.variant.method for draw in self.draws if draw.group.variant)
        return (self.cell.variant.method, *own)

    @property
    def decides(self) -> Mapping[str, object]:
        return {"raster": identity(self.scene, self.cell.proxy, self.draws)}

    @property
    def programs(self) -> Programs:
        batches = tuple(draw.batch(reports=True) for draw in self.draws)
        return dataclasses.replace(super().programs, batches=batches)

    def with_programs(self, programs: Programs) -> Casting:
        if not len(programs.batches) == len(programs.others) == len(self.draws):
            raise FirsthitError("that revision does not hand over what it draws")
        theirs = zip(self.draws, programs.others, programs.batches, strict=True)
        drawn = (dataclasses.replace(own, timed=timed, check=b.program, geometry=b) for own, timed, b in theirs)
        return RasterCasting(self.asked, self.scene, tuple(drawn))

    def frame(self) -> Frame | None:
        return self._frame(self.samples, reports=False)

    def _frame(self, size: int, reports: bool, free_loops: bool = False) -> RasterFrame:
        """Build the frame of size × size pixels; with `reports` by the programs that report what they answered."""
        batches = tuple(draw.batch(reports) for draw in self.draws)
        if free_loops:
            batches = tuple(dataclasses.replace(batch, program=with_free_loops(batch.program)) for batch in batches)
        return RasterFrame(batches, self.camera, depth_map(self.scene, self.camera), size)

    def cast(self, executor: Executor, size: int, free_loops: bool = False) -> Cast:
        cell, surface = self.cell, self.cell.surface
        drawn = RasterCheck(self._frame(size, True, free_loops), fill_program(), twice=not free_loops)
        checked = executor.check(cell.device, drawn)
        picture, alone = checked.answer, cell.scene is None
        hits = hits_of(self.scene, picture, cell.origin)
        facts = {} if free_loops else self._fragments(executor)
        grey = picture.colours[:, :3].astype(np.float32).mean(axis=1) / 255.0
        shade = np.where(picture.batch >= 0, grey, np.nan).astype(np.float32).reshape(size, size)
        pictures = {} if alone else {"shade": shade}
        return SceneCast(surface, picture.rays, hits, checked.compile_ms, facts, pictures, self.scene, picture, alone)

    def _fragments(self, executor: Executor) -> dict[str, int]:
        """Count the fragments of the frame that is timed; they are leaves of the row's accuracy."""
        whole = RasterCheck(self._frame(self.samples, reports=True), fill_program(), twice=False)
        picture = executor.check(self.cell.device, whole).answer
        fragments, found = (int(counts.sum(dtype=np.int64)) for counts in (picture.fragments, picture.fragment_hits))
        return {
            "fragments": fragments,
            "fragments_discarded": fragments - found,
            "pixels_drawn": int((picture.batch >= 0).sum()),
        }

    def rays_held(self, choice: AccuracyChoice) -> int:
        return choice.size**2 + self.samples**2  # the whole frame is drawn once, to count its fragments

    def samples_shade(self, executor: Executor, size: int) -> NDArray[np.float32] | None:
        return None


class Raster(Kind):
    """Make castings of scenes, or of one surface alone, in stage raster."""

    def refusal(self, asked: Asked) -> str | None:
        cell = asked.cell
        if reason := self.lacking(asked):
            return reason
        if cell.precision != "float32":
            return "the stage raster is float32, as its vertices and its depth buffer are"
        if cell.prepass != "none":
            return NO_PREPASS
        scene = cell.scene or single(cell.surface, cell.view)
        return refusal(scene, cell.variant, asked.catalog) or too_many(
            scene, cell.variant, asked.catalog, asked.most_triangles
        )

    def lacking(self, asked: Asked) -> str | None:
        rasterises = asked.info is not None and able(asked.info)
        return None if rasterises else "the stage raster needs a rasteriser, and the device has none"

    def facts(self, cell: Cell) -> KindFacts:
        own: KindFacts = super().facts(cell)
        return {**own, "proxy": cell.proxy, "normal": cell.normal, "pixel_tolerance": cell.tolerance}

    def casting(self, asked: Asked) -> Casting:
        cell = asked.cell
        scene = cell.scene or single(cell.surface, cell.view)
        depth_map(scene, camera_for(cell.view, cell.surface))  # refuses an eye inside an instance
        drawn = draws(scene, cell.variant, cell.proxy, asked.catalog, cell.tolerance, cell.origin, cell.normal)
        once = asked.shared.program
        drawn = tuple(dataclasses.replace(draw, timed=once(draw.timed), check=once(draw.check)) for draw in drawn)
        return RasterCasting(asked, scene, drawn)
