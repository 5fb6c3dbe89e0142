"""A rasterised frame held against the oracle, on the very rays that its fragments cast.

The accuracy grid is drawn as a picture of its own by programs that write their rays. A pixel that no proxy covers was
answered by the rasteriser: its answer is a miss. Fragments are counted on the frame that is timed.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import answers, freeloops, judge
from harness.accuracy.pictures import pictures_of
from harness.accuracy.scene_truth import Seen, scale_of, scene_truth
from harness.contract import Hits, Origin
from harness.devices.executor import LocalExecutor
from harness.devices.frames import Picture
from harness.experiment.config import AccuracyChoice
from harness.experiment.plan import Planned
from harness.scenes.camera import meets, pixel_footprint, scene_radius
from harness.scenes.model import Scene


@dataclass(frozen=True, eq=False)
class Outcome:
    summary: dict[str, Any]
    pictures: dict[str, NDArray[Any]]
    compile_ms: float
    fault: str | None  # of the device's compiler, if one was found


def check(executor: LocalExecutor, planned: Planned, config: AccuracyChoice, folder: Path) -> Outcome:
    """Draw the accuracy grid and the frame once with reporting programs; `folder` keeps the oracle's answers."""
    cell, camera, scene = planned.cell, planned.camera, planned.scene
    drawn = executor.rasterise(cell.device, planned.raster_frame(config.size, reports=True), twice=True)
    picture = drawn.picture
    rays = picture.rays
    truth: Seen = scene_truth(scene, rays, picture, folder, config.grazing_margin * scene_radius(cell.surface))
    hits = hits_of(scene, picture, cell.origin)
    verdicts = judge.judge(hits, truth.truth, scene_radius(cell.surface), config.grazing_margin, cell.precision)
    alone = cell.scene is None
    deviations = (
        judge.deviations(cell.surface, rays, hits, truth.truth, verdicts)
        if alone
        else judge.Deviations(np.full(len(rays), np.nan), np.full(len(rays), np.nan))
    )
    summary = judge.summarize(
        cell.surface,
        hits,
        truth.truth,
        verdicts,
        deviations,
        precision=cell.precision,
        footprint=pixel_footprint(camera, cell.size),
        grazing_margin=config.grazing_margin,
    )

    def cast_freely() -> Hits:
        freely = planned.raster_frame(config.size, reports=True, free_loops=True)
        return hits_of(scene, executor.rasterise(cell.device, freely, twice=False).picture)

    fault = freeloops.removed((draw.check for draw in planned.draws), hits, cast_freely)
    whole = planned.raster_frame(planned.samples, reports=True)
    frame = executor.rasterise(cell.device, whole, twice=False).picture
    fragments, found = int(frame.fragments.sum(dtype=np.int64)), int(frame.fragment_hits.sum(dtype=np.int64))
    summary = {"size": config.size, "domain_rays": int(meets(cell.surface.domain, rays).sum())} | summary
    summary |= {
        "fragments": fragments,
        "fragments_discarded": fragments - found,
        "pixels_drawn": int((frame.batch >= 0).sum()),
        "other_instance": int((truth.other_instance(picture) & verdicts.clear).sum()),
    }
    pictures = pictures_of(cell.surface, rays, hits, truth.truth, verdicts, config.size)
    if not alone:
        grey = picture.colours[:, :3].astype(np.float32).mean(axis=1) / 255.0
        pictures["shade"] = (
            np.where(picture.batch >= 0, grey, np.nan).astype(np.float32).reshape(config.size, config.size)
        )
    return Outcome(summary, pictures, drawn.compile_ms, fault)


def hits_of(scene: Scene, picture: Picture, origin: Origin = "nearest") -> Hits:
    """What a frame with reporting programs answered, in world units; INVALID where that can be no answer: what is seen
    is to lie in its surface's domain, a triangle in front of the eye."""
    possible = picture.in_world & (picture.t >= 0.0)
    for number, group in enumerate(scene.groups):
        mine = np.flatnonzero((picture.batch == number) & ~picture.in_world)
        numbers = {surface: k for k, surface in enumerate(group.distinct)}
        kind = np.broadcast_to([numbers[surface] for surface in group.surfaces], len(group))[picture.instance[mine]]
        for surface, k in numbers.items():
            at = mine[kind == k]
            possible[at] = answers.reachable(surface.domain, picture.local_rays[at], picture.t[at], origin=origin)
    return answers.only(picture.hits(scale_of(scene, picture)), possible)
