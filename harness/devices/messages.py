"""Define what a worker is asked for, and what it answers: frames to time, checks to read.

A message holds programs and buffers only, and knows how a device launches them. So a worker has no case for each way of
casting. The messages of rays are here; those of other kinds are beside their launches, in `beams`, `narrowed` and
`raster`. Messages travel between processes: they hold what can be pickled.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from harness.contract import DeviceInfo, FirsthitError, Hits, Program
from harness.devices.interface import Array, Built, Device, Launch, hits_from, launch_camera, launch_rays, same_values

Answer = TypeVar("Answer")


@dataclass(frozen=True)
class Checked(Generic[Answer]):
    """Hold what a check answered, and the milliseconds that building its programs took."""

    answer: Answer
    compile_ms: float


@dataclass(frozen=True)
class Warmed:
    """Hold what a frame costs apart from running, and how often it is repeated within one sample.

    bytes: of instances, triangles and vertices that a rasterised frame keeps on the device; None for other frames
    """

    compile_ms: float
    upload_ms: float
    readback_ms: float
    batch: int
    bytes: int | None = None


class Frame(ABC):
    """State a frame that is timed."""

    @property
    @abstractmethod
    def programs(self) -> tuple[Program, ...]:
        """Return the programs that `launch` needs, in the order in which it takes them built."""

    @abstractmethod
    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        """Upload the frame, ready to run; `built` holds `programs`, built.

        Raises FirsthitError if the device cannot cast it.
        """


class Check(ABC, Generic[Answer]):
    """State a launch whose answers are read.

    It is run twice: a program that answers otherwise the second time has no answers.
    """

    @property
    @abstractmethod
    def programs(self) -> tuple[Program, ...]:
        """Return the programs that `run` needs, in the order in which it takes them built."""

    @abstractmethod
    def run(self, device: Device, built: Sequence[Built]) -> Answer:
        """Run the programs and return their answer. `built` holds `programs`, built.

        Raises FirsthitError if the answers of two runs differ, or if the device cannot cast.
        """


@dataclass(frozen=True, eq=False)
class FirstRun:
    """Hold what the first run of a check left: the device, the hits of each ray or pixel, and all outputs."""

    info: DeviceInfo
    hits: Hits
    outputs: Sequence[Array]


class HitsCheck(Check[Answer]):
    """State a check whose outputs hold a hit for each ray or pixel."""

    @abstractmethod
    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        """Upload what is cast, ready to run. `built` holds `programs`, built."""

    @abstractmethod
    def hits(self, outputs: Sequence[Array]) -> Hits:
        """Read the hits [n] in a launch's outputs. Two runs must give the same hits, to the last bit."""

    @abstractmethod
    def answer(self, first: FirstRun) -> Answer:
        """Make the answer from the first run."""

    def run(self, device: Device, built: Sequence[Built]) -> Answer:
        launch = self.launch(device, built)
        outputs, again = [_outputs(launch) for _ in range(2)]
        launch.release()
        hits, others = self.hits(outputs), self.hits(again)
        same = [same_values(values, getattr(others, name)) for name, values in vars(hits).items()]
        need_steady(~np.logical_and.reduce(same), "rays")
        return self.answer(FirstRun(device.info, hits, outputs))


def _outputs(launch: Launch) -> list[Array]:
    launch.run()
    return [output.copy() for output in launch.read()]


def need_steady(differs: NDArray[np.bool_], what: str) -> None:
    """Raise FirsthitError if the same program answered differently on the same input; `differs` is bool[n]."""
    if differs.any():
        message = f"two runs of the program answer {int(differs.sum())} of {len(differs)} {what} differently"
        raise FirsthitError(f"{message}: its kernel reads what nobody wrote, or the device is at fault", exit_code=3)


@dataclass(frozen=True, eq=False)
class CameraFrame(Frame):
    """State a frame of one ray for each sample of a camera's image.

    camera: float32[12] (eye, forward, right, up)
    size: samples per side
    """

    program: Program
    camera: NDArray[np.float32]
    size: int

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        return launch_camera(device, self.program, built[0], self.camera, self.size)


@dataclass(frozen=True, eq=False)
class ListedFrame(Frame):
    """State a frame of listed rays, float32[n, 6]."""

    program: Program
    rays: NDArray[np.float32]

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        return launch_rays(device, self.program, built[0], self.rays)


@dataclass(frozen=True, eq=False)
class ListedCheck(HitsCheck[Hits]):
    """State a check that casts listed rays, float32[n, 6], and reads the hit of each."""

    program: Program
    rays: NDArray[np.float32]

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        return launch_rays(device, self.program, built[0], self.rays)

    def hits(self, outputs: Sequence[Array]) -> Hits:
        return hits_from(outputs)

    def answer(self, first: FirstRun) -> Hits:
        return first.hits
