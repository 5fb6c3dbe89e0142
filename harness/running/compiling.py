"""Compile methods' kernels on devices, without casting a ray: what `firsthit compile` prints."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
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
    together: bool = False,
) -> Compiled:
    """Compile every program of each method for each surface, device and precision that it accepts, at its defaults.

    Devices take turns or, if `together`, compile at once, and then each is slowed by the others. Each program is run
    once over one ray, for which it has `timeout` seconds. After one that does not end nothing more of the method is
    tried on that device, since each further one would take as long. `tell` hears of each case.
    """
    cases = list(itertools.product(plugins, surfaces, PRECISIONS))
    numbers, total = itertools.count(1), len(cases) * len(devices)

    def told(case: str) -> None:
        tell(f"compiling [{next(numbers)}/{total}] {case}")

    each = [_OnDevice(info, timeout, told) for info in devices]
    pool = ThreadPoolExecutor(max(1, len(devices)) if together else 1)
    try:
        for future in [pool.submit(one.compile, cases) for one in each]:
            future.result()
    finally:  # also where Ctrl-C ends it
        for one in each:
            one.stop()
        pool.shutdown(cancel_futures=True)
    failed = [failure for one in each for failure in one.failed]
    return Compiled({one.info.name: one.built for one in each}, failed, sum(one.left_out for one in each))


class _OnDevice:
    """Compile cases for one device, in the order in which they are given."""

    def __init__(self, info: DeviceInfo, timeout: float, tell: Tell) -> None:
        self.info = info
        self.built: list[tuple[float, str]] = []
        self.failed: list[Failure] = []
        self.left_out = 0
        self._executor, self._tell = LocalExecutor(timeout), tell
        self._stopped = threading.Event()

    def compile(self, cases: Iterable[tuple[Plugin, Surface, Precision]]) -> None:
        hung: set[str] = set()
        try:
            for plugin, surface, precision in cases:
                if self._stopped.is_set():
                    return
                self._tell(f"{plugin.method.name} {surface.name} {precision} {self.info.name}")
                if plugin.method.name in hung:
                    self.left_out += 1
                elif self._case(plugin, surface, precision) is CellStatus.TIMEOUT:
                    hung.add(plugin.method.name)
        finally:
            self._executor.close()

    def stop(self) -> None:
        """Begin no further case, and end the one under way, from any thread."""
        self._stopped.set()
        self._executor.kill()

    def _case(self, plugin: Plugin, surface: Surface, precision: Precision) -> CellStatus | None:
        """Compile the programs of a case; return how it ended where it failed."""
        name, method = self.info.name, plugin.method.name
        try:
            if _is_refused(plugin, surface, self.info, precision):
                return None
            for entry, program in _programs(plugin, surface, self.info, precision).items():
                took = self._executor.build(name, program)
                self.built.append((took, f"{method} {surface.name} {precision} {entry}"))
        except (CellError, FirsthitError) as error:
            status = error.status if isinstance(error, CellError) else CellStatus.FAILED
            of = method, f"{surface.name} {precision}", name, precision, surface.name
            self.failed.append(Failure(*of, str(error), status))
            return status
        return None


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
