"""Cast rays by one method on one device, for people who want to see its answers. Nothing is timed or stored."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import compilers
from harness.contract import (
    CellStatus,
    DeviceInfo,
    FirsthitError,
    Hits,
    Origin,
    Precision,
    Program,
    Surface,
    Variant,
)
from harness.devices.discovery import discover_devices, usable_devices
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.interface import LANGUAGES, no_device
from harness.experiment.kinds import of_method
from harness.experiment.kinds.shots import Shot, ShotKind
from harness.kernels.assemble import STAGES, Language, lanes_on, method_program
from harness.kernels.complaints import complaints_in
from harness.limits import TIMEOUT, held, hold
from harness.oracle import checked_t_min
from harness.plugins import Plugin
from harness.running.failures import Failure, mistakes

UNIT_LENGTH = 1e-5  # by how much the length of a ray's direction may differ from 1

Tell = Callable[[str], None]


def ignore(_line: str) -> None:
    """Take a line and do nothing with it: for callers that want to hear nothing."""


@dataclass(frozen=True)
class Caster:
    """Holds a method with values for its knobs, and says where and how it casts.

    `timeout` is in seconds and for one step, such as compiling or casting all rays. Raises FirsthitError for a
    precision or an origin that does not exist and for a timeout that is outside its limits and, with exit code 3, for a
    device of a kind that does not exist.
    """

    plugin: Plugin
    variant: Variant
    device: str
    precision: Precision = "float32"
    origin: Origin = "nearest"
    timeout: Annotated[float, TIMEOUT] = 60.0

    def __post_init__(self) -> None:
        hold(self)
        if self.device.partition(":")[0] not in LANGUAGES:
            raise no_device(self.device, (info.name for info in discover_devices()))

    @property
    def language(self) -> Language:
        """Return the language that the device's compiler takes."""
        return LANGUAGES[self.device.partition(":")[0]]


def usable_device(name: str | None = None) -> DeviceInfo:
    """Find the device of that name, or the first one that works where `name` is None.

    Raises FirsthitError where `name` is no text and, with exit code 3, where there is no such device or none works.
    """
    return usable_devices([] if name is None else [held("device", name, str)])[0]


def checked_rays(rays: object, what: str = "rays") -> NDArray[np.float32]:
    """Return `rays` if they are float32[n, 6] with n > 0: origins, and directions of length 1, all finite.

    Raises FirsthitError otherwise. Its text starts with `what` and names the first bad row.
    """
    if not isinstance(rays, np.ndarray) or rays.ndim != 2 or rays.shape[1] != 6:
        shape = getattr(rays, "shape", f"of type {type(rays).__name__}")
        raise FirsthitError(f"{what}: the array must be [n, 6], origin and direction of each ray; it is {shape}")
    if rays.dtype != np.float32:
        raise FirsthitError(f"{what}: they are {rays.dtype}; make them float32, since that is what devices are given")
    if not len(rays):
        raise FirsthitError(f"{what}: there are no rays in it")
    bad = ~np.isfinite(rays).all(axis=1)
    if bad.any():
        raise FirsthitError(f"{what}: row {int(bad.argmax())} (counted from 0) is not finite")
    lengths = np.linalg.norm(rays[:, 3:].astype(np.float64), axis=1)
    bad = np.abs(lengths - 1.0) > UNIT_LENGTH
    if bad.any():
        row = int(bad.argmax())
        raise FirsthitError(f"{what}: row {row} (counted from 0) has a direction of length {lengths[row]:.6g}, not 1")
    return rays


def cast(
    caster: Caster,
    surface: Surface,
    rays: NDArray[np.float32],
    camera: NDArray[np.float32] | None = None,
    t_min: float = 0.0,
    tell: Tell = ignore,
) -> Hits:
    """Cast rays float32[n, 6] from the distance `t_min` on, in a process that holds the device.

    A method that casts beams needs the camera, float32[12]: the rays are those of its square image, row by row, and the
    method answers for the rays' pixels. Impossible answers (harness.accuracy.answers) are INVALID. `tell` is called
    with a sentence where f, evaluated on the host, contradicts some answers.

    Raises FirsthitError where the method refuses the surface, and with exit code 3 where the kernel fails, hangs,
    crashes or gives other answers when it is run again, or where the device's compiler is found at fault
    (harness/accuracy/compilers.py).
    """
    from harness.kernels.functions import too_long, unsupported

    t_min = checked_t_min(t_min)
    method = caster.plugin.method
    stated = caster.precision, caster.language
    if reason := (method.accepts(surface) or unsupported(surface, *stated) or too_long(surface, method.needs, *stated)):
        raise FirsthitError(f"{caster.variant} cannot draw {surface.name} here: {reason}")
    kind = of_method(method)
    if reason := kind.shot_refusal(camera):
        raise FirsthitError(f"{caster.variant} {reason}")
    assert isinstance(kind, ShotKind)  # shot_refusal refuses all others
    shot = Shot(rays, camera, dict(caster.variant.parameters), surface, t_min, caster.origin)
    where = f"{caster.variant} on {caster.device}"
    info = _info(caster.device) if STAGES.keys() & set(kind.shot_entries) else None
    executor = LocalExecutor(caster.timeout)

    def programs(language: Language) -> tuple[Program, ...]:
        stated = method, caster.plugin.folder, caster.variant, surface, caster.precision, language
        lanes = lanes_on(language, info if language == caster.language else None)
        return tuple(
            method_program(*stated, entry, t_min=t_min, origin=caster.origin, lanes=lanes)
            for entry in kind.shot_entries
        )

    def launch(device: str, programs: tuple[Program, ...], index: NDArray[np.intp]) -> Hits:
        return kind.shot_hits(executor.check(device, kind.shot(programs, shot, index)).answer)

    try:
        hits = launch(caster.device, programs(caster.language), np.arange(len(rays)))
        hits = kind.validated(hits, surface, shot)
        if not method.answers:
            return hits
        second = compilers.SecondBuild(caster.device, caster.precision, programs, launch)
        doubts = compilers.doubts_about(surface, rays, hits, second, t_min)
    except CellError as error:
        what = {CellStatus.TIMEOUT: "timed out", CellStatus.CRASHED: "crashed"}.get(error.status, "failed")
        of = method.name, "", caster.device, caster.precision, surface.name, str(error), error.status
        told = mistakes([Failure(*of)], "programs")[0] if complaints_in(str(error)) else error
        raise FirsthitError(f"{where} {what}: {told}", exit_code=3) from None
    finally:
        executor.close()
    if doubts.fault:
        raise FirsthitError(f"{where}: {doubts.fault}", exit_code=3)
    if doubts.note:
        tell(f"{caster.variant} on {surface.name}: {doubts.note}")
    return hits


def _info(device: str) -> DeviceInfo | None:
    """Look for what is known of a device, which decides how stages of tiles are made; None if it is not here."""
    return next((info for info in discover_devices([device]) if info.name == device), None)
