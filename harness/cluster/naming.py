"""Name the devices of a cluster: as on their machine where that says which one, else with the machine's name."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field

from harness.cluster.places import Place
from harness.contract import DeviceInfo, FirsthitError, digest
from harness.devices.host import Host
from harness.devices.interface import INSTALL
from harness.running.fastest import Tried


@dataclass(frozen=True, eq=False)
class Named:
    """Hold the devices of a cluster by their names.

    A device is all places that compute alike: their driver, hardware, processor, cores and settings are the same, so
    that a cell's row is the same on each of them but for the clock's noise.
    """

    kinds: Mapping[str, str] = field(default_factory=dict)  # what a device's places have in common, by its name
    tried: Mapping[str, Tried] = field(default_factory=dict)
    hosts: Mapping[str, Host] = field(default_factory=dict)
    machines: Mapping[str, tuple[str, ...]] = field(default_factory=dict)  # of each device

    def wanted(self, name: str) -> Callable[[Place], bool]:
        """Return what tells whether a place is the device of that name."""
        kind = self.kinds[name]
        return lambda place: kind_of(place) == kind


def kind_of(place: Place) -> str:
    """Return what all places of one device have in common. Clocks may differ, since probes choose them."""
    info = dataclasses.asdict(dataclasses.replace(place.info, clock="wall"))
    return digest(info, dataclasses.asdict(place.host))


def named(places: Sequence[Place], wanted: Collection[str]) -> Named:
    """Name the devices of places.

    A device has its own name, or `NAME@MACHINE` where there are several of that name, or where `wanted` calls it so;
    the machine is the first of its places'. Raises FirsthitError where `wanted` has a name that several devices share.
    """
    groups: dict[str, list[Place]] = {}
    for place in sorted(places, key=lambda place: (_order(place.device), place.device, place.machine)):
        groups.setdefault(kind_of(place), []).append(place)
    several: dict[str, list[str]] = {}
    for group in groups.values():
        several.setdefault(group[0].device, []).append(f"{group[0].device}@{group[0].machine}")
    for name in wanted:
        if len(several.get(name, ())) > 1:
            told = f"there are several devices {name!r} in the cluster; name one of {', '.join(several[name])}"
            raise FirsthitError(told, exit_code=3)
    kinds, tried, hosts, machines = {}, {}, {}, {}
    for kind, group in groups.items():
        machine = next((p.machine for p in group if f"{p.device}@{p.machine}" in wanted), None)
        alone = len(several[group[0].device]) == 1 and machine is None
        name = group[0].device if alone else f"{group[0].device}@{machine or group[0].machine}"
        kinds[name], hosts[name] = kind, group[0].host
        tried[name] = _told(name, group)
        machines[name] = tuple(dict.fromkeys(place.machine for place in group))
    return Named(kinds, tried, hosts, machines)


def _told(name: str, group: Sequence[Place]) -> Tried:
    """Return what is told of a device: its clock is believed where that of each of its places is."""
    believed = all(place.info.clock == "device" for place in group)
    info: DeviceInfo = dataclasses.replace(group[0].info, name=name, clock="device" if believed else "wall")
    return info, group[0].probes


def _order(device: str) -> int:
    return list(INSTALL).index(device.partition(":")[0])
