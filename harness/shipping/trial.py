"""Run a shipped program on a device beside the harness's own, and hold their answers against each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Hits, Program, RayStatus, View, plural
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.interface import Array, Built, Device, Launch, hits_from, launch_camera, real_type, same_values
from harness.devices.messages import FirstRun, HitsCheck
from harness.scenes.camera import camera_for
from harness.shipping.program import Shipment

SIZE = 128  # pixels per side of the picture that both programs draw
VIEW = View("trial")


@dataclass(frozen=True, eq=False)
class CameraCheck(HitsCheck[Hits]):
    """State a check that casts the rays of a camera's image, of size × size samples, and reads the hit of each.

    camera: float32[12]
    """

    program: Program
    camera: NDArray[np.float32]
    size: int

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        return launch_camera(device, self.program, built[0], self.camera, self.size)

    def hits(self, outputs: Sequence[Array]) -> Hits:
        return hits_from(outputs[:2])

    def answer(self, first: FirstRun) -> Hits:
        return first.hits


class DrawCheck(CameraCheck):
    """State a check that casts the same rays by a shipped program, which writes normals too."""

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        pixels = self.size * self.size
        outputs = [(pixels, real_type(self.program)), (pixels, np.int32), (3 * pixels, np.float32)]
        return device.launch(built[0], [self.camera], outputs, (self.size, self.size))


@dataclass(frozen=True)
class Trial:
    """Hold what a trial found: how many rays were cast, how many of them hit, and what compiling took."""

    rays: int
    hits: int
    compile_ms: float


def try_on(shipment: Shipment, device: str, timeout: float) -> Trial:
    """Draw a small picture on a device by the shipped program and by the harness's own.

    Each step has `timeout` seconds. Raises FirsthitError, with exit code 3, where a program fails there or the two
    answer a ray differently, to the last bit.
    """
    camera = camera_for(VIEW, shipment.surface)
    executor = LocalExecutor(timeout)
    try:
        shipped = executor.check(device, DrawCheck(shipment.program, camera, SIZE))
        checked = executor.check(device, CameraCheck(shipment.checked, camera, SIZE))
    except CellError as error:
        raise FirsthitError(f"{shipment.variant} on {device}: {error}", exit_code=3) from None
    finally:
        executor.close()
    mine, theirs = vars(shipped.answer), vars(checked.answer)
    same = np.logical_and.reduce([same_values(mine[name], theirs[name]) for name in theirs])
    if not same.all():
        rays = f"{int((~same).sum())} of {plural(same.size, 'ray')}"
        told = f"answers {rays} otherwise than the program that firsthit checks"
        raise FirsthitError(f"on {device} the shipped program {told}; nothing was written", exit_code=3)
    return Trial(same.size, int((shipped.answer.status == RayStatus.HIT).sum()), shipped.compile_ms)
