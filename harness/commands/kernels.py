"""Offer `firsthit compile`: compile every kernel on every device, which finds mistakes sooner than a run does."""

from __future__ import annotations

import argparse
import statistics
import sys

from harness import console
from harness.commands import Add
from harness.commands.options import add_timeout, methods_of, named_surface
from harness.contract import plural
from harness.devices.discovery import usable_devices
from harness.running.compiling import compile_all
from harness.running.failures import mistakes

TYPICAL = ("sphere", "torus", "barth_sextic")  # domains box and ball; with coefficients along a ray, and without


def add_parsers(add: Add) -> None:
    parser = add("compile", "firsthit compile --method newton")
    parser.add_argument("--method", action="append", metavar="NAME", help="only this one; may be repeated")
    parser.add_argument("--surface", action="append", metavar="NAME", help=f"default: {', '.join(TYPICAL)}")
    parser.add_argument("--formula", metavar="F", help="f(x, y, z) of your own beside them")
    parser.add_argument("--domain", metavar="D", default="sphere:1.5", help="its domain (default: sphere:1.5)")
    parser.add_argument("--device", action="append", metavar="NAME", help="may be repeated (default: every usable one)")
    help_ = "compile for all devices at once: sooner done, but each compiler is slowed by the others"
    parser.add_argument("--together", action="store_true", help=help_)
    add_timeout(parser)
    parser.set_defaults(run=_compile)


def _compile(options: argparse.Namespace) -> int:
    import surfaces

    catalog = methods_of(options)
    plugins = [catalog.get(name) for name in options.method or sorted(catalog.plugins)]
    chosen = [named_surface(name) for name in options.surface or (TYPICAL if options.formula is None else ())]
    chosen += [] if options.formula is None else [surfaces.from_formula(options.formula, options.domain)]
    usable = usable_devices(options.device or ())
    with console.working() as tell:
        done = compile_all(plugins, chosen, usable, tell, options.timeout, options.together)
    broken = [] if options.method else list(catalog.broken)
    for paragraph in mistakes(done.failed, "programs"):
        print(paragraph, file=sys.stderr)
    for name, programs in done.built.items():
        if programs:
            typical, (most, which) = statistics.median(took for took, _ in programs), max(programs)
            times = f"{typical * 1e-3:.2f} s each, at most {most * 1e-3:.2f} s: {which}"
            print(f"{name}: {plural(len(programs), 'program')}, {times}")
    total = sum(map(len, done.built.values()))
    left_out = f", {done.left_out} not tried after one that did not end" if done.left_out else ""
    unloaded = f"; not loaded: {', '.join(broken)}" if broken else ""
    tried = f"{plural(total, 'program')} compiled on {plural(len(usable), 'device')}"
    print(f"{tried}, {len(done.failed)} failed{left_out}{unloaded}")
    return 3 if done.failed or broken else 0
