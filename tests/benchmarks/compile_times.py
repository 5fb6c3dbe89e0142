"""Measure compile times of growing formulas: `python -m tests.benchmarks.compile_times DEVICE METHOD`.

It prints what MOST_OPERATIONS of harness/kernels/functions.py is taken from. The formulas are unions of spheres; the
series ends with the first program that takes more than LIMIT seconds. For a method that casts polynomials only, they
are dense random polynomials of growing degree, and each program that its kind needs is compiled, such as the stages of
tiles: those that are timed, and those that a check takes in their places. Nothing is asserted.
"""

from __future__ import annotations

import random
import sys

from harness.conformance import dense
from harness.contract import Language, Sphere, Surface
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.interface import LANGUAGES
from harness.experiment.kinds import of_method
from harness.kernels import functions
from harness.kernels.assemble import method_program
from harness.plugins import Plugin, find_methods

SIZES = (10, 30, 100, 200, 300, 1000, 3000)  # spheres; each has about nine operations
DEGREES = (4, 8, 12, 16, 20)
LIMIT = 40.0


def union(count: int) -> Surface:
    """Return the union of so many random spheres."""
    pick = random.Random(1)
    parts = []
    for _ in range(count):
        away = " + ".join(f"({axis} - ({pick.randint(-900, 900) / 1000}))^2" for axis in "xyz")
        parts.append(f"sqrt({away}) - {pick.randint(10, 100) / 1000}")
    text = f"min({', '.join(parts)})"
    return Surface("union", "union", text, Sphere(1.5), "random", degree=None, distance=text)


def main(device: str, name: str) -> None:
    """Print a line for each size: operations of the program's functions, and the seconds."""
    functions.MOST_OPERATIONS = {
        language: dict.fromkeys(("real", "interval"), 10**9) for language in LANGUAGES.values()
    }
    plugin = find_methods().get(name)
    language = LANGUAGES[device.partition(":")[0]]
    if plugin.method.accepts(union(SIZES[0])) is not None:
        polynomials(device, plugin, language)
        return
    for count in SIZES:
        stated = plugin.method, plugin.folder, plugin.variant({}), union(count), "float32", language
        program = method_program(*stated, of_method(plugin.method).entries[0])  # type: ignore[arg-type]
        lines = [line.lstrip() for section in program.sections for line in section.text.split("\n")]
        reals, intervals = (sum(line.startswith(f"{kind} a") for line in lines) for kind in ("real", "Interval"))
        operations = f"{reals} operations on reals and {intervals} on intervals"
        executor = LocalExecutor(LIMIT)
        try:
            seconds = executor.build(device, program) / 1e3
            print(f"{device} {name}: {count} spheres, {operations}: {seconds:.1f} s", flush=True)
            if seconds > LIMIT:
                return
        except CellError as error:
            print(f"{device} {name}: {count} spheres, {operations}: {error}")
            return
        finally:
            executor.close()


def polynomials(device: str, plugin: Plugin, language: Language) -> None:
    """Print a line for each of DEGREES: the seconds for each program of the method's kind, and the longest."""
    executor = LocalExecutor(LIMIT)
    try:
        for degree in DEGREES:
            surface = dense.surface_of(degree, dense.seed_of(degree))
            took: dict[str, float] = {}
            for entry in of_method(plugin.method).entries:
                stated = plugin.method, plugin.folder, plugin.variant({}), surface, "float32", language
                took[entry] = executor.build(device, method_program(*stated, entry)) / 1e3  # type: ignore[arg-type]
            told = ", ".join(f"{entry} {seconds:.1f} s" for entry, seconds in took.items())
            print(
                f"{device} {plugin.method.name}: degree {degree}: {told}; the longest {max(took.values()):.1f} s",
                flush=True,
            )
    except CellError as error:
        print(f"{device} {plugin.method.name}: degree {degree}: {error}")
    finally:
        executor.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
