"""Compile methods' kernels on devices, without casting a ray: what `firsthit compile` prints."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from harness.contract import PRECISIONS, CellStatus, DeviceInfo, FirsthitError, Precision, Program, Surface
from harness.devices.executor import START_SECONDS, CellError, LocalExecutor
from harness.devices.interface import LANGUAGES
from harness.experiment.kinds import of_method
from harness.experiment.targets import able
from harness.kernels.assemble import lanes_on, method_program
from harness.plugins import Plugin
from harness.running.failures import Failure

Tell = Callable[[str], None]


@dataclass(eq=False)
class Compiled:
    """Hold what compiling led to.

    built: for each device the time in ms that each program took, and which program it is
    failed: each case that could not be compiled, with the compiler's message
    left_out: how many cases were not tried, since another one of the method did not end on that device
    """

    built: dict[str, list[tuple[float, str]]]
    failed: list[Failure] = field(default_factory=list)
    left_out: int = 0


def compile_all(
    plugins: Sequence[Plugin],
    surfaces: Sequence[Surface],
    devices: Sequence[DeviceInfo],
    tell: Tell = lambda _: None,
    timeout: float = START_SECONDS,
) -> Compiled:
    """Compile every program of each method for each surface, device and precision that it accepts, at its defaults.

    Each program is run once over one ray, for which it has `timeout` seconds. After one that does not end nothing more
    of the method is tried on that device, since each further one would take as long. `tell` hears of each case.
    """
    executor = LocalExecutor(timeout)
    done = Compiled({info.name: [] for info in devices})
    hung: set[tuple[str, str]] = set()
    cases = list(itertools.product(plugins, surfaces, devices, PRECISIONS))
    try:
        for number, (plugin, surface, info, precision) in enumerate(cases, 1):
            method = plugin.method
            tell(f"compiling [{number}/{len(cases)}] {method.name} {surface.name} {precision} {info.name}")
            if (method.name, info.name) in hung:
                done.left_out += 1
                continue
            try:
                if _is_refused(plugin, surface, info, precision):
                    continue
                for entry, program in _programs(plugin, surface, info, precision).items():
                    took = executor.build(info.name, program)
                    done.built[info.name].append((took, f"{method.name} {surface.name} {precision} {entry}"))
            except (CellError, FirsthitError) as error:
                status = error.status if isinstance(error, CellError) else CellStatus.FAILED
                of = method.name, f"{surface.name} {precision}", info.name, precision, surface.name
                done.failed.append(Failure(*of, str(error), status))
                if status is CellStatus.TIMEOUT:
                    hung.add((method.name, info.name))
    finally:
        executor.close()
    return done


def _is_refused(plugin: Plugin, surface: Surface, info: DeviceInfo, precision: Precision) -> bool:
    """Tell whether method, language or device refuses the surface or the precision."""
    from harness.kernels.functions import too_long, unsupported

    if precision not in plugin.method.precisions or (precision == "float64" and not info.float64):
        return True
    method, language = plugin.method, LANGUAGES[info.name.partition(":")[0]]
    return bool(
        method.accepts(surface)
        or unsupported(surface, precision, language)
        or too_long(surface, method.needs, precision, language)
    )


def _programs(plugin: Plugin, surface: Surface, info: DeviceInfo, precision: Precision) -> dict[str, Program]:
    """Assemble a method's programs, by the entry that each is started as."""
    kind, variant = of_method(plugin.method), plugin.variant({})
    language = LANGUAGES[info.name.partition(":")[0]]
    stated, lanes = (
        (plugin.method, plugin.folder, variant, surface, precision, language),
        lanes_on(language, info),
    )
    texts: dict[str, Program] = {entry: method_program(*stated, entry, lanes=lanes) for entry in kind.entries}
    drawn = kind.compiled_drawing(plugin, surface) if precision == "float32" and able(info) else None
    return texts | ({"raster": drawn} if drawn else {})
