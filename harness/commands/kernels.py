"""compile: every kernel through every compiler, before anyone waits for a run to find the typing mistake."""

from __future__ import annotations

import argparse
import itertools
import statistics
import sys

from harness.commands import Add
from harness.contract import PRECISIONS, FirsthitError, Program
from harness.devices.discovery import discover_devices
from harness.devices.executor import START_SECONDS, CellError, LocalExecutor
from harness.devices.interface import LANGUAGES, working
from harness.experiment.kinds import of_method
from harness.experiment.targets import able
from harness.kernels.assemble import method_program
from harness.plugins import find_methods

TYPICAL = ("sphere", "torus", "barth_sextic")  # box and ball, coefficients along the ray and none


def add_parsers(add: Add) -> None:
    parser = add("compile", "firsthit compile --method newton")
    parser.add_argument("--method", action="append", metavar="NAME", help="only this one; may be repeated")
    parser.add_argument("--surface", action="append", metavar="NAME", help=f"default: {', '.join(TYPICAL)}")
    parser.add_argument("--formula", metavar="F", help="f(x, y, z) of your own beside them")
    parser.add_argument("--domain", metavar="D", default="sphere:1.5", help="its domain (default: sphere:1.5)")
    parser.set_defaults(run=_compile)


def _compile(options: argparse.Namespace) -> int:
    import surfaces
    from harness.kernels.functions import unsupported

    catalog = find_methods(options.plugins)
    plugins = [catalog.get(name) for name in options.method or sorted(catalog.plugins)]
    chosen = [surfaces.get(name) for name in options.surface or (() if options.formula else TYPICAL)]
    chosen += [surfaces.from_formula(options.formula, options.domain)] if options.formula else []
    usable = working(discover_devices())
    executor = LocalExecutor(START_SECONDS)
    built: dict[str, list[tuple[float, str]]] = {info.name: [] for info in usable}
    failed = [f"{name}: {reason}" for name, reason in catalog.broken.items() if not options.method]
    try:
        for plugin, surface, info, precision in itertools.product(plugins, chosen, usable, PRECISIONS):
            method, language = plugin.method, LANGUAGES[info.name.partition(":")[0]]
            kind = of_method(method)
            refused = method.accepts(surface) or unsupported(surface, precision, language)
            if refused or precision not in method.precisions or (precision == "float64" and not info.float64):
                continue
            try:
                texts: dict[str, Program] = {
                    entry: method_program(
                        method, plugin.folder, plugin.variant({}), surface, precision, language, entry
                    )
                    for entry in kind.entries
                }
                drawn = kind.compiled_drawing(plugin, surface) if precision == "float32" and able(info) else None
                if drawn:
                    texts["raster"] = drawn
                for entry, program in texts.items():
                    took = executor.build(info.name, program)
                    built[info.name].append((took, f"{method.name} {surface.name} {precision} {entry}"))
            except (CellError, FirsthitError) as error:
                failed.append(f"{method.name} {surface.name} {precision} {info.name}: {error}")
    finally:
        executor.close()
    for line in failed:
        print(line, file=sys.stderr)
    for name, programs in built.items():
        if programs:
            typical, (most, which) = statistics.median(took for took, _ in programs), max(programs)
            print(
                f"{name}: {len(programs)} programs, {typical * 1e-3:.2f} s each, at most {most * 1e-3:.2f} s: {which}"
            )
    total = sum(map(len, built.values()))
    print(f"{total} programs compiled on {len(usable)} devices, {len(failed)} failed")
    return 3 if failed else 0
