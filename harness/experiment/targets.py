"""Choose the devices that an experiment runs on."""

from __future__ import annotations

from harness.contract import DeviceInfo, FirsthitError
from harness.devices.interface import RASTERISES, no_device
from harness.experiment.config import Experiment


def choose_devices(
    wanted: list[str], found: list[DeviceInfo], rasterises: bool = False
) -> dict[str, DeviceInfo | None]:
    """Return the devices to run on by name; None for a named one that is not here.

    `any` is the first one that works and, with `rasterises`, draws triangles. `all` leaves out a broken double of a
    working device (one driver that is installed twice).
    """
    by_name = {info.name: info for info in found}
    chosen: dict[str, DeviceInfo | None] = {}
    working = {info.name.split("-")[0] for info in found if not info.problem}
    for name in wanted:
        if name == "all":
            chosen |= {i.name: i for i in found if not i.problem or i.name.split("-")[0] not in working}
        elif name == "any":
            chosen |= dict(
                [(info.name, info) for info in found if not info.problem and (able(info) or not rasterises)][:1]
            )
        else:
            chosen[name] = by_name.get(name)
    return chosen


def able(info: DeviceInfo) -> bool:
    """Tell whether a device rasterises."""
    return info.name.partition(":")[0] in RASTERISES


def devices_of(experiment: Experiment, found: list[DeviceInfo], rasterises: bool) -> dict[str, DeviceInfo | None]:
    """Return the devices that a config's cells run on; with `rasterises`, `any` is one that draws triangles.

    Raises FirsthitError if none of the devices that the config names is among those `found`.
    """
    wanted = experiment.config.devices
    chosen = choose_devices(wanted, found, rasterises)
    if not any(chosen.values()):
        if not set(wanted) <= {"all", "any"}:
            raise no_device(", ".join(wanted), (info.name for info in found))
        raise FirsthitError("no usable device found on this machine; see `firsthit devices`", exit_code=3)
    return chosen
