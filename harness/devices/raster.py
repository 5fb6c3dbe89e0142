"""Say what a device draws by rasterisation, and what a check reads of the picture.

Devices without a rasteriser refuse such frames. harness.devices.opengl_raster draws them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Hits, Program, Proxy, RayStatus
from harness.devices.interface import Built, Device, Launch, same_values
from harness.devices.messages import Check, Frame, need_steady
from harness.kernels.raster import PROXY_SIDES

RECORD = 32  # float32 of an instance, see harness/kernels/glsl/raster/instance.glsl


@dataclass(frozen=True, eq=False)
class Batch:
    """State one draw call: n instances of one proxy or mesh, drawn by one program.

    instances: float32[n, RECORD], see harness/kernels/glsl/raster/instance.glsl
    triangles: uint32[3 k], numbers of the proxy's corners or of the mesh's vertices
    vertices: float32[v, 6], position and normal in local units; None for a proxy
    closed: the geometry is closed, so that its back faces are not drawn
    """

    program: Program
    instances: NDArray[np.float32]
    triangles: NDArray[np.uint32]
    vertices: NDArray[np.float32] | None
    closed: bool


@dataclass(frozen=True, eq=False)
class Picture:
    """Hold what the reporting programs of a frame answered for its n pixels, row by row from the top left.

    "Seen" is the instance that is in front at a pixel. Counts are over all fragments that fell on the pixel, drawn or
    hidden.

    colours: uint8[n, 4]
    rays: float32[n, 6], the pixels' rays in world coordinates
    local_rays: float32[n, 6], the same rays in the coordinates of the instance that is seen
    t: float64[n], along the local ray, in local lengths; NaN if nothing is seen
    batch: int32[n], number of the batch of the instance that is seen; -1 if nothing is seen
    instance: int32[n], number of the instance that is seen, within its batch
    in_world: bool[n], a triangle of a mesh is seen, whose t and ray are the world's
    fragments: int32[n] as all that follow, fragments of proxies and triangles
    fragment_hits: those with a hit, seen or hidden
    exhausted: those that gave up
    evaluations: spent by all of them
    invalid: those whose answer is impossible
    """

    colours: NDArray[np.uint8]
    rays: NDArray[np.float32]
    local_rays: NDArray[np.float32]
    t: NDArray[np.float64]
    batch: NDArray[np.int32]
    instance: NDArray[np.int32]
    in_world: NDArray[np.bool_]
    fragments: NDArray[np.int32]
    fragment_hits: NDArray[np.int32]
    exhausted: NDArray[np.int32]
    evaluations: NDArray[np.int32]
    invalid: NDArray[np.int32]

    def hits(self, scale: NDArray[np.float64]) -> Hits:
        """Return the pixels' answers with t in world units; `scale` float64[n] is that of the instance that is seen.

        A pixel where nothing is seen is exhausted if one of its fragments gave up, and a miss otherwise. It is invalid
        if one of its fragments gave an impossible answer, since that one may have been in front, and also if a fragment
        has a hit and yet nothing is seen.
        """
        gave_up = np.where(self.exhausted > 0, RayStatus.EXHAUSTED, RayStatus.MISS)
        status = np.where(self.batch >= 0, RayStatus.HIT, gave_up)
        bad = (self.invalid > 0) | (self.evaluations < 0) | ((self.fragment_hits > 0) & (self.batch < 0))
        status = np.where(bad, RayStatus.INVALID, status).astype(np.uint8)
        return Hits(np.where(bad, np.nan, self.t * scale), status, np.where(bad, 0, self.evaluations))

    def differing(self, other: Picture) -> NDArray[np.bool_]:
        """Return bool[n], the pixels that differ in anything from `other`, the same frame drawn again."""
        differs = np.zeros(len(self.t), bool)
        for name, values in vars(self).items():
            same = same_values(values, getattr(other, name))
            differs |= ~same.reshape(len(differs), -1).all(axis=1)
        return differs


def corners(proxy: Proxy) -> NDArray[np.uint32]:
    """Return a proxy's k triangles, uint32[3 k]: the numbers of its corners, counterclockwise as seen from outside."""
    if proxy == "sphere":
        fan = [(0, k, k + 1) for k in range(1, PROXY_SIDES - 1)]
        return np.array(fan, np.uint32).ravel()
    if proxy == "tetrahedron":
        return np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)], np.uint32).ravel()
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return np.array([(a, b, c, a, c, d) for a, b, c, d in sides], np.uint32).ravel()


class Rasteriser(ABC):
    """Define what a device that draws triangles can do in addition to a `Device`."""

    @abstractmethod
    def launch_raster(
        self,
        batches: Sequence[Batch],
        built: Sequence[Built],
        camera: NDArray[np.float32],
        depth_map: tuple[float, float],
        size: int,
        fill: Built | None = None,
    ) -> RasterLaunch:
        """Upload batches, to be drawn by their built programs into an image of size × size pixels.

        `camera` is float32[12], `depth_map` as in RasterFrame. With the built `fill` program the batches' programs
        report what they answer, and the launch's `picture()` can be read.
        """


class RasterLaunch(Launch):
    """Draw, and read the picture that reporting programs leave."""

    @abstractmethod
    def picture(self) -> Picture:
        """Read what the batches' programs reported in the last run."""


@dataclass(frozen=True, eq=False)
class RasterFrame(Frame):
    """State batches that are drawn in order into a camera's image.

    camera: float32[12] (eye, forward, right, up)
    depth_map: a, b of the depth buffer's a + b / s, at depth s
    size: pixels per side
    """

    batches: tuple[Batch, ...]
    camera: NDArray[np.float32]
    depth_map: tuple[float, float]
    size: int

    @property
    def programs(self) -> tuple[Program, ...]:
        return tuple(batch.program for batch in self.batches)

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        return self.drawn(device, built, None)

    def drawn(self, device: Device, built: Sequence[Built], fill: Built | None) -> RasterLaunch:
        """Upload the frame; `fill` is as in Rasteriser.launch_raster.

        Raises FirsthitError if the device draws no triangles.
        """
        if not isinstance(device, Rasteriser):
            raise FirsthitError(f"{device.info.name} draws no triangles")
        return device.launch_raster(self.batches, built, self.camera, self.depth_map, self.size, fill)


@dataclass(frozen=True, eq=False)
class RasterCheck(Check[Picture]):
    """State a check that draws a frame whose batches report what they answer, and reads its picture.

    With `twice` two pictures are drawn and compared. Each is uploaded anew, since a launch's counts add up from run to
    run.

    fill: the program that reports every pixel's ray
    """

    frame: RasterFrame
    fill: Program
    twice: bool = True

    @property
    def programs(self) -> tuple[Program, ...]:
        return (*self.frame.programs, self.fill)

    def run(self, device: Device, built: Sequence[Built]) -> Picture:
        pictures: list[Picture] = []
        for _ in range(1 + self.twice):
            launch = self.frame.drawn(device, built[:-1], built[-1])
            launch.run()
            pictures.append(launch.picture())
            launch.release()
        need_steady(pictures[0].differing(pictures[-1]), "pixels")
        return pictures[0]
