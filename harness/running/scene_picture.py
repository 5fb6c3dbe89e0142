"""Draw a scene's picture by rasterisation, as one method draws it: what `firsthit scene` saves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness import memory
from harness.accuracy.answers import invalid
from harness.accuracy.check import BYTES_PER_RAY
from harness.accuracy.scene_truth import hits_of
from harness.contract import FirsthitError, Origin, Proxy, Variant
from harness.devices.discovery import discover_devices
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.raster import RasterCheck, RasterFrame
from harness.experiment.kinds import draws
from harness.experiment.targets import able
from harness.kernels.raster import fill_program
from harness.plugins import Catalog
from harness.running.picture import RAYS_PER_PIXEL
from harness.scenes.camera import camera_for
from harness.scenes.model import Scene
from harness.scenes.records import depth_map


@dataclass(frozen=True, eq=False)
class ScenePicture:
    """Hold a scene's picture, and what drawing it took; each pixel is the mean of four samples."""

    pixels: NDArray[np.uint8]  # [size, size, 3], row 0 at the top, on white
    drawn: float  # the share of the samples that show an instance
    fragments: int  # fragments that ran
    hits: int  # those of them that were not discarded
    invalid: int  # samples whose answer is impossible (harness.accuracy.answers)


def draw_scene(
    scene: Scene, variant: Variant, catalog: Catalog, proxy: Proxy, origin: Origin, size: int, timeout: float
) -> ScenePicture:
    """Draw a scene as `size` pixels a side, on the first device here that rasterises.

    `variant` draws the instances that have no method of their own; `timeout` is in seconds and for one step. Raises
    FirsthitError where a method cannot draw the scene, and with exit code 3 where no device rasterises, one fails, or
    memory does not hold the rays.
    """
    what = f"a picture of {size}x{size} pixels, with {RAYS_PER_PIXEL} rays each,"
    if reason := memory.refusal(BYTES_PER_RAY * RAYS_PER_PIXEL * size**2, what, "take a smaller size"):
        raise FirsthitError(reason, exit_code=3)
    if reason := draws.refusal(scene, variant, catalog):
        raise FirsthitError(f"{variant} cannot draw {scene.name}: {reason}")
    usable = [info.name for info in discover_devices() if able(info) and not info.problem]
    if not usable:
        raise FirsthitError("no device that rasterises; `firsthit devices` says what is here", exit_code=3)
    camera = camera_for(scene.view, scene.stand_in)
    batches = tuple(draw.batch(True) for draw in draws.draws(scene, variant, proxy, catalog, origin=origin))
    depths, side = depth_map(scene, camera), 2 * size
    executor = LocalExecutor(timeout)
    try:
        frame = RasterFrame(batches, camera, depths, side)
        picture = executor.check(usable[0], RasterCheck(frame, fill_program())).answer
    except CellError as error:
        raise FirsthitError(f"{variant} on {usable[0]}: {error}", exit_code=3) from None
    finally:
        executor.close()
    shown = picture.batch >= 0
    colours = np.where(shown[:, None], picture.colours[:, :3], np.uint8(255)).astype(np.float64)
    four = colours.reshape(size, 2, size, 2, 3)
    return ScenePicture(
        pixels=np.round(four.mean(axis=(1, 3))).astype(np.uint8),
        drawn=float(np.mean(shown)),
        fragments=int(picture.fragments.sum(dtype=np.int64)),
        hits=int(picture.fragment_hits.sum(dtype=np.int64)),
        invalid=invalid(hits_of(scene, picture, origin)),
    )
