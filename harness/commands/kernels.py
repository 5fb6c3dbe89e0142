"""Offer `firsthit compile`: compile every kernel on every device, which finds mistakes sooner than a run does."""

from __future__ import annotations

import argparse
import statistics
import sys

from harness.commands import Add
from harness.devices.discovery import usable_devices
from harness.plugins import find_methods
from harness.running.compiling import compile_all

TYPICAL = ("sphere", "torus", "barth_sextic")  # domains box and ball; with coefficients along a ray, and without


def add_parsers(add: Add) -> None:
    parser = add("compile", "firsthit compile --method newton")
    parser.add_argument("--method", action="append", metavar="NAME", help="only this one; may be repeated")
    parser.add_argument("--surface", action="append", metavar="NAME", help=f"default: {', '.join(TYPICAL)}")
    parser.add_argument("--formula", metavar="F", help="f(x, y, z) of your own beside them")
    parser.add_argument("--domain", metavar="D", default="sphere:1.5", help="its domain (default: sphere:1.5)")
    parser.set_defaults(run=_compile)


def _compile(options: argparse.Namespace) -> int:
    import surfaces

    catalog = find_methods(options.plugins)
    plugins = [catalog.get(name) for name in options.method or sorted(catalog.plugins)]
    chosen = [surfaces.get(name) for name in options.surface or (TYPICAL if options.formula is None else ())]
    chosen += [] if options.formula is None else [surfaces.from_formula(options.formula, options.domain)]
    usable = usable_devices()
    done = compile_all(plugins, chosen, usable)
    broken = [f"{name}: {reason}" for name, reason in catalog.broken.items() if not options.method]
    failed = broken + done.failed
    for line in failed:
        print(line, file=sys.stderr)
    for name, programs in done.built.items():
        if programs:
            typical, (most, which) = statistics.median(took for took, _ in programs), max(programs)
            print(
                f"{name}: {len(programs)} programs, {typical * 1e-3:.2f} s each, at most {most * 1e-3:.2f} s: {which}"
            )
    total = sum(map(len, done.built.values()))
    print(f"{total} programs compiled on {len(usable)} devices, {len(failed)} failed")
    return 3 if failed else 0
