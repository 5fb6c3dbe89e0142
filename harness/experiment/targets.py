"""Choose the devices that an experiment runs on."""

from __future__ import annotations

from collections.abc import Mapping

from harness.contract import DeviceInfo, FirsthitError, LostDevice
from harness.devices.interface import RASTERISES, lost, no_device, told_lost
from harness.experiment.config import FASTEST, Experiment

AS_FAST = 0.9  # share of the highest peak from which on a device counts as fast: two probes of a device differ by more


def choose_devices(
    wanted: list[str], found: list[DeviceInfo], rasterises: bool = False
) -> dict[str, DeviceInfo | None]:
    """Return the devices to run on by name; None for a named one that is not here, a LostDevice where nobody can tell.

    `any` is the first one that works and, with `rasterises`, draws triangles. `all` leaves out a broken double of a
    working device (one driver that is installed twice). Raises ValueError for `fastest`, which is no choice before
    peaks are measured: harness.running.fastest puts a name in its place.
    """
    by_name = {info.name: info for info in found}
    chosen: dict[str, DeviceInfo | None] = {}
    working = {info.name.split("-")[0] for info in found if not info.problem}
    for name in wanted:
        if name == FASTEST:
            raise ValueError("the fastest device must be found before cells are planned")
        if name == "all":
            chosen |= {i.name: i for i in found if not i.problem or i.name.split("-")[0] not in working}
        elif name == "any":
            chosen |= {info.name: info for info in usable(found, rasterises)[:1]}
        else:
            chosen[name] = by_name.get(name) or lost(name, found)
    return chosen


def able(info: DeviceInfo) -> bool:
    """Tell whether a device rasterises."""
    return info.name.partition(":")[0] in RASTERISES


def usable(found: list[DeviceInfo], rasterises: bool) -> list[DeviceInfo]:
    """List the devices that work and, with `rasterises`, draw triangles."""
    return [info for info in found if not info.problem and (able(info) or not rasterises)]


def ranked(measured: Mapping[DeviceInfo, float]) -> list[DeviceInfo]:
    """Sort devices by their peaks, with the one that is `fastest` first; `measured` is in the order of finding.

    A GPU comes before a device that is none. Of devices whose peaks are within AS_FAST of the highest the first that
    was found is the fastest, so that noise does not choose between two drivers of one GPU.
    """
    falling = sorted(measured, key=lambda info: (info.resident is None, -measured[info]))
    highest = falling[:1]
    alike = [
        info
        for info in measured
        for best in highest
        if (info.resident is None) == (best.resident is None) and measured[info] >= AS_FAST * measured[best]
    ]
    return list(dict.fromkeys((*alike[:1], *falling)))


def devices_of(experiment: Experiment, found: list[DeviceInfo], rasterises: bool) -> dict[str, DeviceInfo | None]:
    """Return the devices that a config's cells run on; with `rasterises`, `any` is one that draws triangles.

    Raises FirsthitError if none of the devices that the config names is among those `found`, or all that are were lost.
    """
    wanted = experiment.wanted_devices()
    chosen = choose_devices(wanted, found, rasterises)
    gone = [info for info in chosen.values() if isinstance(info, LostDevice)]
    if gone and not any(info and not info.problem for info in chosen.values()):
        raise told_lost(gone)
    if not any(chosen.values()):
        if not set(wanted) <= {"all", "any"}:
            raise no_device(", ".join(wanted), (info.name for info in found))
        raise none_usable()
    return chosen


def none_usable() -> FirsthitError:
    """Return the error for a machine that has no device that works."""
    return FirsthitError("no usable device found on this machine; see `firsthit devices`", exit_code=3)
