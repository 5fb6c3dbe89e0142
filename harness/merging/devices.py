"""Name the devices of a merged run: with the machine, where one name stands for different devices.

A device is another one where the facts that its driver states, the processor, the settings of drivers or the number of
cores differ, since rows then have other keys. Machines that agree in all of them are one device, whatever their names.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from harness.merging.found import Cell, Hardware

Device = tuple[str, Hardware]  # its own name, and what it is


def of(cells: Iterable[Cell]) -> dict[int, Device]:
    """Return the device of each cell that a device ran, by the cell's id.

    A cell that is not timed does not tell its cores: it is taken for the device that has the same facts.
    """
    ran = [(cell, cell.made.hardware) for cell in cells if cell.made and cell.made.hardware.facts is not None]
    cores: dict[tuple[str, str | None], set[int]] = {}
    for cell, hardware in ran:
        if hardware.cores is not None:
            cores.setdefault((cell.own, hardware.facts), set()).add(hardware.cores)
    found = {}
    for cell, hardware in ran:
        known = cores.get((cell.own, hardware.facts), set())
        number = hardware.cores if hardware.cores is not None else min(known, default=None)
        found[id(cell)] = (cell.own, Hardware(hardware.facts, number))
    return found


def names(cells: Iterable[Cell], devices: Mapping[int, Device]) -> dict[Device, str]:
    """Return how each device is told: `opencl:nvidia`, or `opencl:nvidia@lab2` where that name stands for several.

    The machine is that of the device's oldest row. Where two devices have one machine, as before and after a driver's
    update, the later one has a number: `opencl:nvidia@lab2-2`. The order in which runs are merged changes no name.
    """
    first: dict[Device, tuple[str, str, str]] = {}  # when its oldest row was made, where, and its facts
    for cell in cells:
        device = devices.get(id(cell))
        if device is not None and cell.made is not None:
            here = (cell.made.started, cell.made.machine, str(device[1]))
            first[device] = min(first.get(device, here), here)
    alike: dict[str, list[Device]] = {}
    for device in sorted(first, key=lambda device: first[device]):
        alike.setdefault(device[0], []).append(device)
    told = {}
    for own, several in alike.items():
        taken: dict[str, int] = {}
        for device in several:
            machine = first[device][1]
            taken[machine] = taken.get(machine, 0) + 1
            number = f"-{taken[machine]}" if taken[machine] > 1 else ""
            told[device] = f"{own}@{machine}{number}" if len(several) > 1 else own
    return told
