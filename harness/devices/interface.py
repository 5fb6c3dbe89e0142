"""Define what a device can do: build a program, launch it, time it, and read back what it wrote.

Everything above this room sees only this module, and no backend. A device is opened by name (`opencl:intel`) in the
process that uses it.
"""

from __future__ import annotations

import importlib
import importlib.util
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import UNFOUND, DeviceInfo, FirsthitError, Hits, LostDevice, Program, RayStatus
from harness.kernels.assemble import Language

Array = NDArray[Any]
Built = Any  # a program as a backend has built it, for launches of the same device only
INSTALL = {"opencl": "pyopencl", "opengl": "moderngl"}
LANGUAGES: dict[str, Language] = {"opengl": "glsl", "opencl": "cl"}
# Work items that fill a GPU's compute unit: it has 65,536 registers, and beams and ranges may need 64 of them each
GPU_RESIDENT = 1024
RASTERISES = ("opengl",)  # backends whose devices draw triangles


class BuildError(Exception):
    """Report that a program does not compile. The message names file and line of the section that is at fault."""


@dataclass(frozen=True)
class Timing:
    """Hold one timed repetition.

    wall_ms: the host's time from submitting the work until it is finished
    device_ms: by the device's own clock; None if it has none
    processor_ms: what the process that holds the device spent meanwhile on the processor, all threads together; None if
        nobody looked
    """

    wall_ms: float
    device_ms: float | None
    processor_ms: float | None = None


@dataclass(frozen=True)
class Step:
    """State one of the steps that a launch takes in order: a built program over a grid of work items.

    The program is given the launch's `buffers`, by their places, then the grid, then `numbers` (in GLSL by their
    names). `group` is how many work items share a work group; None: as many as the device takes for items that share
    nothing. A GLSL program states its own, which must be the same.
    """

    built: Built
    buffers: tuple[int, ...]
    grid: tuple[int, int]
    numbers: Mapping[str, int] = field(default_factory=dict)
    group: int | None = None


@dataclass(frozen=True)
class Reserved:
    """State a buffer of `count` numbers of the type `kind`, each of which starts as `fill`; None: as anything."""

    count: int
    kind: type
    fill: int | None = None

    def filled(self) -> Array:
        """Return what the buffer starts with, [max(1, count)] of the type `kind`; `fill` must be given."""
        assert self.fill is not None
        return np.full(max(1, self.count), self.fill, self.kind)


class Launch(ABC):
    """Hold built programs and their buffers on a device, ready to run again and again.

    upload_ms: what uploading the buffers took
    """

    upload_ms: float

    @abstractmethod
    def run(self, times: int = 1) -> Timing:
        """Run `times` times back to back and wait until finished; the times are of all runs together.

        The device's time of a run is from its first step's beginning to its last step's end.
        """

    @abstractmethod
    def read(self) -> list[Array]:
        """Read back the outputs, in the order in which they were asked for: each is one-dimensional, [count]."""

    @abstractmethod
    def release(self) -> None:
        """Free the buffers on the device. The launch cannot be run or read afterwards."""


class StepLaunch(Launch):
    """Hold a launch of steps, whose buffers can be given other values before it is run again."""

    @abstractmethod
    def write(self, place: int, values: Array) -> None:
        """Upload values into the buffer at `place`, which holds as many of the same type."""


class Device(ABC):
    """Hold an open device."""

    info: DeviceInfo
    language: Language

    @abstractmethod
    def build(self, program: Program) -> Built:
        """Compile a program, for launches of this device only. Raises BuildError if the driver's compiler refuses."""

    def said(self, built: Built) -> str:
        """Return what the compiler said of a program that it built; "" where the binding does not tell."""
        del built
        return ""

    @abstractmethod
    def launch_steps(
        self, buffers: Sequence[Array | Reserved], outputs: Sequence[int], steps: Sequence[Step]
    ) -> StepLaunch:
        """Upload or reserve `buffers`, and make ready to take `steps`; the buffers at the places `outputs` can be read.

        Raises FirsthitError if the device cannot run so many work items at once.
        """

    def launch(
        self, built: Built, inputs: Sequence[Array], outputs: Sequence[tuple[int, type]], grid: tuple[int, int]
    ) -> Launch:
        """Upload `inputs`, reserve `outputs`, and make ready to run one work item for each point of `grid`.

        An output is a count and a type. Raises FirsthitError as `launch_steps` does.
        """
        buffers: list[Array | Reserved] = [*inputs, *(Reserved(count, kind) for count, kind in outputs)]
        places = tuple(range(len(buffers)))
        return self.launch_steps(buffers, places[len(inputs) :], [Step(built, places, grid)])


def real_type(program: Program) -> type:
    """Return the type of a program's reals."""
    return np.float32 if program.precision == "float32" else np.float64


def launch_rays(device: Device, program: Program, built: Built, rays: NDArray[np.float32]) -> Launch:
    """Launch a program over listed rays float32[n, 6], origins and directions, which are used as they are given."""
    count = len(rays)
    outputs = [(2 * count, real_type(program)), (count, np.int32)]
    return device.launch(built, [np.ascontiguousarray(rays, np.float32)], outputs, (count, 1))


def launch_camera(device: Device, program: Program, built: Built, camera: NDArray[np.float32], size: int) -> Launch:
    """Launch a program over the rays of a camera's image of size × size samples.

    `camera` is float32[12] (eye, forward, right, up).
    """
    outputs = [(size * size, real_type(program)), (size * size, np.int32)]
    return device.launch(built, [np.ascontiguousarray(camera, np.float32)], outputs, (size, size))


def hits_from(outputs: Sequence[Array]) -> Hits:
    """Read the hits [n] that a launch of entry `rays` or `camera` answered.

    t of a listed ray comes in two parts, which are added in float64.
    """
    t, answer = outputs
    whole = t.astype(np.float64)
    if len(whole) == 2 * len(answer):
        whole = whole[0::2] + whole[1::2]
    return unpacked(whole, answer, answer & 3, answer >> 2)


def unpacked(t: Array, word: Array, status: Array, evaluations: Array) -> Hits:
    """Return the answers [n] that are packed in `word`, int32[n].

    `word` is negative if the kernel gave a status that does not exist, or a count out of range. Otherwise `status` and
    `evaluations`, int32[n], are the parts of `word`.
    """
    status = np.where(word < 0, RayStatus.INVALID, status).astype(np.uint8)
    spent = np.where(status == RayStatus.INVALID, 0, evaluations).astype(np.int32)
    return Hits(np.where(status == RayStatus.HIT, t.astype(np.float64), np.nan), status, spent)


def same_values(a: NDArray[Any], b: NDArray[Any]) -> NDArray[np.bool_]:
    """Return bool[...], of the arrays' own shape: where two arrays of one shape and type have the same bits.

    Every NaN is the same.
    """
    if a.dtype.kind != "f":
        return np.asarray(a == b)
    bits = np.dtype(f"u{a.dtype.itemsize}")
    plain = (np.ascontiguousarray(np.where(np.isnan(v), np.array(np.nan, v.dtype), v)).view(bits) for v in (a, b))
    return np.asarray(np.equal(*plain))


def map_rows(device: Device, program: Program, rows: Array, outputs: int) -> Array:
    """Run a map program over rows [n, INPUTS], and return [n, outputs] in the program's precision."""
    kind = real_type(program)
    launch = device.launch(
        device.build(program), [np.ascontiguousarray(rows, kind)], [(len(rows) * outputs, kind)], (len(rows), 1)
    )
    launch.run()
    result = launch.read()[0].reshape(len(rows), outputs)
    launch.release()
    return result


def find_devices(backend: str) -> list[DeviceInfo]:
    """Find every device of an installed backend, "opencl" or "opengl"; a broken one says so in its `problem`."""
    found: list[DeviceInfo] = importlib.import_module(f"harness.devices.{backend}").find()
    return found


def no_device(wanted: str, known: Iterable[str]) -> FirsthitError:
    """Make the error for a device that is not here, which names those that are `known`."""
    names = ", ".join(known) or "none"
    return FirsthitError(f"there is no device {wanted!r} here; known: {names}; see `firsthit devices`", exit_code=3)


def lost(name: str, found: Iterable[DeviceInfo]) -> LostDevice | None:
    """Return the device of that name as one that was lost, if its backend could not be looked at; else None."""
    stand_in = f"{name.partition(':')[0]}{UNFOUND}"
    gone = (info for info in found if isinstance(info, LostDevice) and info.name == stand_in)
    return next((replace(info, name=name) for info in gone), None)


def told_lost(gone: Iterable[LostDevice]) -> FirsthitError:
    """Make the error for devices that were lost, each of which says what happened."""
    return FirsthitError("; ".join(f"{info.name}: {info.problem}" for info in gone), exit_code=3)


def device_named(name: str, found: Iterable[DeviceInfo]) -> DeviceInfo:
    """Return the device of that name. Raises FirsthitError where it is not among those `found`, or cannot be used."""
    by_name = {info.name: info for info in found}
    if name not in by_name:
        gone = lost(name, by_name.values())
        raise told_lost([gone]) if gone else no_device(name, by_name)
    if problem := by_name[name].problem:
        raise FirsthitError(f"device {name!r} cannot be used: {problem}", exit_code=3)
    return by_name[name]


def working(found: Sequence[DeviceInfo]) -> list[DeviceInfo]:
    """Return the devices that can be used. Raises FirsthitError if there is none."""
    usable = [info for info in found if not info.problem]
    if gone := [info for info in found if isinstance(info, LostDevice) and not usable]:
        raise told_lost(gone)
    if not usable:
        raise FirsthitError("no usable device; `firsthit devices` says why", exit_code=3)
    return usable


def open_device(name: str) -> Device:
    """Open a device by name. Raises FirsthitError where it is not here or cannot be used.

    Only devices of its own backend are looked at: another's driver may crash, and would take this process along.
    """
    backend = name.partition(":")[0]
    if backend not in INSTALL:
        installed = [kind for kind, package in INSTALL.items() if importlib.util.find_spec(package)]
        raise no_device(name, [info.name for kind in installed for info in find_devices(kind)])
    if not importlib.util.find_spec(INSTALL[backend]):
        raise FirsthitError(f"device {name!r} needs the package {INSTALL[backend]}: pip install {INSTALL[backend]}")
    module = importlib.import_module(f"harness.devices.{backend}")
    names: list[str] = module.names()
    if name not in names:
        raise no_device(name, names)
    device_named(name, [module.info(name)])
    device: Device = module.open(name)
    return device
