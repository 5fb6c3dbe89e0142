"""What a device draws by rasterisation, and what the check reads of it. Devices without a rasteriser say so."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Hits, Program, RayStatus
from harness.devices.interface import Device, Launch, same_values
from harness.devices.messages import Check, Frame, need_steady

RECORD = 32  # float32 of an instance, see harness/kernels/glsl/raster/instance.glsl


@dataclass(frozen=True, eq=False)
class Batch:
    """One draw call."""

    program: Program
    instances: NDArray[np.float32]  # [n, RECORD]
    triangles: NDArray[np.uint32]  # [3 k] corners of the proxy, or vertices
    vertices: NDArray[np.float32] | None  # [v, 6] position and normal, local units; None for a proxy
    closed: bool  # back faces are not seen


@dataclass(frozen=True, eq=False)
class Picture:
    """What a frame with reporting programs answered, row by row from the top left, n pixels in all."""

    colours: NDArray[np.uint8]  # [n, 4]
    rays: NDArray[np.float32]  # [n, 6] in world coordinates
    local_rays: NDArray[np.float32]  # [n, 6] in the coordinates of who is seen
    t: NDArray[np.float64]  # [n] along the local ray, in local lengths; NaN where nothing is seen
    batch: NDArray[np.int32]  # [n] of who is seen; -1 where nothing is
    instance: NDArray[np.int32]  # [n] of who is seen, within the batch
    in_world: NDArray[np.bool_]  # [n] a triangle of a mesh is seen: its t and ray are the world's
    fragments: NDArray[np.int32]  # [n] of proxies and triangles, drawn or not
    fragment_hits: NDArray[np.int32]  # [n] those with a hit, seen or hidden
    exhausted: NDArray[np.int32]  # [n] those that gave up
    evaluations: NDArray[np.int32]  # [n] spent by all of them
    invalid: NDArray[np.int32]  # [n] those that gave no answer

    def hits(self, scale: NDArray[np.float64]) -> Hits:
        """Return the pixels' answers, t in world units; `scale` float64[n] is that of the instance seen. Without one, a
        pixel with a fragment that gave up is exhausted, and a miss otherwise. A fragment without an answer makes its
        pixel invalid, since it may have been in front, and so does one whose hit lies behind all that there is."""
        gave_up = np.where(self.exhausted > 0, RayStatus.EXHAUSTED, RayStatus.MISS)
        status = np.where(self.batch >= 0, RayStatus.HIT, gave_up)
        bad = (self.invalid > 0) | (self.evaluations < 0) | ((self.fragment_hits > 0) & (self.batch < 0))
        status = np.where(bad, RayStatus.INVALID, status).astype(np.uint8)
        return Hits(np.where(bad, np.nan, self.t * scale), status, np.where(bad, 0, self.evaluations))

    def differing(self, other: Picture) -> NDArray[np.bool_]:
        """bool[n]: pixels of the same frame drawn again that differ in anything."""
        differs = np.zeros(len(self.t), bool)
        for name, values in vars(self).items():
            same = same_values(values, getattr(other, name))
            differs |= ~same.reshape(len(differs), -1).all(axis=1)
        return differs


class Rasteriser(ABC):
    """What a device that draws triangles has beside the rest."""

    @abstractmethod
    def launch_raster(
        self,
        batches: Sequence[Batch],
        built: Sequence[Any],
        camera: NDArray[np.float32],
        depth_map: tuple[float, float],
        size: int,
        fill: Any = None,
    ) -> RasterLaunch:
        """A launch that draws batches by their built programs into a size × size target. With the built `fill` program,
        the batches' programs report, and it has `picture()`."""


class RasterLaunch(Launch):
    """A launch that draws; where its programs report, their picture can be read."""

    @abstractmethod
    def picture(self) -> Picture:
        """What the batches' programs reported in the last run."""


@dataclass(frozen=True, eq=False)
class RasterFrame(Frame):
    """Batches drawn into a camera's image."""

    batches: tuple[Batch, ...]  # in order
    camera: NDArray[np.float32]  # [12]
    depth_map: tuple[float, float]  # a, b of its depth buffer's a + b / s
    size: int  # pixels per side

    @property
    def programs(self) -> tuple[Program, ...]:
        return tuple(batch.program for batch in self.batches)

    def launch(self, device: Device, built: Sequence[Any]) -> Launch:
        return self.drawn(device, built, None)

    def drawn(self, device: Device, built: Sequence[Any], fill: Any) -> RasterLaunch:
        """Upload the frame; see Rasteriser.launch_raster for `fill`. Raises FirsthitError on a device without one."""
        if not isinstance(device, Rasteriser):
            raise FirsthitError(f"{device.info.name} draws no triangles")
        return device.launch_raster(self.batches, built, self.camera, self.depth_map, self.size, fill)


@dataclass(frozen=True, eq=False)
class RasterCheck(Check[Picture]):
    """A frame whose batches report what they answer, and the picture of it.

    With `twice` two pictures are drawn and compared. Each is uploaded anew, since a launch's counts add up from run to
    run.
    """

    frame: RasterFrame
    fill: Program  # reports every pixel's ray
    twice: bool = True

    @property
    def programs(self) -> tuple[Program, ...]:
        return (*self.frame.programs, self.fill)

    def run(self, device: Device, built: Sequence[Any]) -> Picture:
        pictures: list[Picture] = []
        for _ in range(1 + self.twice):
            launch = self.frame.drawn(device, built[:-1], built[-1])
            launch.run()
            pictures.append(launch.picture())
            launch.release()
        need_steady(pictures[0].differing(pictures[-1]), "pixels")
        return pictures[0]
