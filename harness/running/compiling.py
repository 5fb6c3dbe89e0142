"""Compile methods' kernels on devices, without casting a ray: what `firsthit compile` prints."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from harness.contract import PRECISIONS, DeviceInfo, FirsthitError, Precision, Program, Surface
from harness.devices.executor import START_SECONDS, CellError, LocalExecutor
from harness.devices.interface import LANGUAGES
from harness.experiment.kinds import of_method
from harness.experiment.targets import able
from harness.kernels.assemble import method_program
from harness.plugins import Plugin


@dataclass(eq=False)
class Compiled:
    """Hold what compiling led to.

    built: for each device the time in ms that each program took, and which program it is
    failed: a line for each case that could not be compiled, with the compiler's message
    """

    built: dict[str, list[tuple[float, str]]]
    failed: list[str] = field(default_factory=list)


def compile_all(plugins: Iterable[Plugin], surfaces: Iterable[Surface], devices: Sequence[DeviceInfo]) -> Compiled:
    """Compile every program of each method for each surface, device and precision that it accepts, at its defaults."""
    executor = LocalExecutor(START_SECONDS)
    done = Compiled({info.name: [] for info in devices})
    try:
        for plugin, surface, info, precision in itertools.product(plugins, surfaces, devices, PRECISIONS):
            method = plugin.method
            if _is_refused(plugin, surface, info, precision):
                continue
            try:
                for entry, program in _programs(plugin, surface, info, precision).items():
                    took = executor.build(info.name, program)
                    done.built[info.name].append((took, f"{method.name} {surface.name} {precision} {entry}"))
            except (CellError, FirsthitError) as error:
                done.failed.append(f"{method.name} {surface.name} {precision} {info.name}: {error}")
    finally:
        executor.close()
    return done


def _is_refused(plugin: Plugin, surface: Surface, info: DeviceInfo, precision: Precision) -> bool:
    """Tell whether method, language or device refuses the surface or the precision."""
    from harness.kernels.functions import unsupported

    if precision not in plugin.method.precisions or (precision == "float64" and not info.float64):
        return True
    return bool(
        plugin.method.accepts(surface) or unsupported(surface, precision, LANGUAGES[info.name.partition(":")[0]])
    )


def _programs(plugin: Plugin, surface: Surface, info: DeviceInfo, precision: Precision) -> dict[str, Program]:
    """Assemble a method's programs, by the entry that each is started as."""
    kind, variant = of_method(plugin.method), plugin.variant({})
    stated = plugin.method, plugin.folder, variant, surface, precision, LANGUAGES[info.name.partition(":")[0]]
    texts: dict[str, Program] = {entry: method_program(*stated, entry) for entry in kind.entries}
    drawn = kind.compiled_drawing(plugin, surface) if precision == "float32" and able(info) else None
    return texts | ({"raster": drawn} if drawn else {})
