"""What a worker is asked for, and what it answers: frames to time, checks to read.

A message holds programs and buffers only, and knows how a device launches them; so a worker holds no case for each way
of casting. Those of rays stand here, the others beside their launches (`beams`, `narrowed`, `frames`).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from harness.contract import DeviceInfo, FirsthitError, Hits, Program
from harness.devices.interface import Array, Device, Launch, hits_from, launch_camera, launch_rays, same_values

Answer = TypeVar("Answer")


@dataclass(frozen=True)
class Checked(Generic[Answer]):
    """Holds what a check answered, and the milliseconds that building its programs took."""

    answer: Answer
    compile_ms: float


@dataclass(frozen=True)
class Warmed:
    """Holds what a frame cost apart from running, and how often it is repeated within one sample."""

    compile_ms: float
    upload_ms: float
    readback_ms: float
    batch: int
    bytes: int | None = None  # of instances, triangles and vertices that a rasterised frame keeps on the device


class Frame(ABC):
    """A frame that is timed."""

    @property
    @abstractmethod
    def programs(self) -> tuple[Program, ...]:
        """The programs that `launch` needs, in the order in which it takes them built."""

    @abstractmethod
    def launch(self, device: Device, built: Sequence[Any]) -> Launch:
        """Upload the frame. Raises FirsthitError where the device cannot cast it."""


class Check(ABC, Generic[Answer]):
    """A launch whose answers are read.

    It is run twice: a program that answers otherwise the second time has no answers.
    """

    @property
    @abstractmethod
    def programs(self) -> tuple[Program, ...]:
        """The programs that `run` needs, in the order in which it takes them built."""

    @abstractmethod
    def run(self, device: Device, built: Sequence[Any]) -> Answer:
        """Run the programs. Raises FirsthitError where the answers of two runs differ, or the device cannot."""


@dataclass(frozen=True, eq=False)
class FirstRun:
    """Holds what the first run of a check left: the hits of each ray or pixel, and all outputs of the launch."""

    info: DeviceInfo
    hits: Hits
    outputs: Sequence[Array]


class HitsCheck(Check[Answer]):
    """A check whose outputs hold a hit for each ray or pixel."""

    @abstractmethod
    def launch(self, device: Device, built: Sequence[Any]) -> Launch:
        """Upload what is cast."""

    @abstractmethod
    def hits(self, outputs: Sequence[Array]) -> Hits:
        """Read the hits in a launch's outputs."""

    @abstractmethod
    def answer(self, first: FirstRun) -> Answer:
        """Make the answer from the first run."""

    def run(self, device: Device, built: Sequence[Any]) -> Answer:
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
    """Raise FirsthitError where the same program on the same input answered differently; `differs` is bool[n]."""
    if differs.any():
        message = f"two runs of the program answer {int(differs.sum())} of {len(differs)} {what} differently"
        raise FirsthitError(f"{message}: its kernel reads what nobody wrote, or the device is at fault", exit_code=3)


@dataclass(frozen=True, eq=False)
class CameraFrame(Frame):
    """A ray for each sample of a camera's image."""

    program: Program
    camera: NDArray[np.float32]  # [12]
    size: int  # samples per side

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Any]) -> Launch:
        return launch_camera(device, self.program, built[0], self.camera, self.size)


@dataclass(frozen=True, eq=False)
class ListedFrame(Frame):
    """Listed rays."""

    program: Program
    rays: NDArray[np.float32]  # [n, 6]

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Any]) -> Launch:
        return launch_rays(device, self.program, built[0], self.rays)


@dataclass(frozen=True, eq=False)
class ListedCheck(HitsCheck[Hits]):
    """Listed rays, and what is hit by each."""

    program: Program
    rays: NDArray[np.float32]  # [n, 6]

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Any]) -> Launch:
        return launch_rays(device, self.program, built[0], self.rays)

    def hits(self, outputs: Sequence[Array]) -> Hits:
        return hits_from(outputs)

    def answer(self, first: FirstRun) -> Hits:
        return first.hits
