"""Offer `firsthit kernel`: a method's program for a surface, to be taken into programs of one's own."""

from __future__ import annotations

import argparse
from pathlib import Path

from harness.commands import Add
from harness.commands.options import (
    add_origin,
    add_surface,
    add_timeout,
    given_variant,
    methods_of,
    surface_of,
    surface_words,
)
from harness.contract import PRECISIONS, FirsthitError, Language, Precision, Variant, plural
from harness.devices.interface import LANGUAGES
from harness.escaping import shell
from harness.plugins import Catalog
from harness.results.writing import write_new
from harness.running.trace import usable_device
from harness.shipping.package import package
from harness.shipping.program import Shipment
from harness.shipping.trial import try_on

NAMED: dict[str, Language] = {"glsl": "glsl", "opencl": "cl"}
NO_WGSL = (
    "--language wgsl: programs are not written in WGSL. It has no float64 and nothing like `precise`, so compilers "
    "may change what error-free sums and interval bounds rest on. Take glsl or opencl"
)


def add_parsers(add: Add) -> None:
    parser = add(
        "kernel",
        "firsthit kernel --surface torus --method newton --language glsl -o torus-newton",
        "Write a method's whole program for a surface into a folder, and an example that draws it and needs nothing of "
        "firsthit. With --device the program is run there first, and its answers are held against those of the program "
        "that firsthit checks, bit for bit. No file that is there is changed.",
    )
    add_surface(parser)
    parser.add_argument("--method", required=True, metavar="NAME", help="see `firsthit list methods`")
    parser.add_argument("--knob", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the method")
    parser.add_argument("--precision", choices=PRECISIONS, default="float32")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--device", metavar="NAME", help="write it in this device's language, and try it there")
    where.add_argument("--language", choices=(*NAMED, "wgsl"), default="glsl", help="default: glsl; wgsl is refused")
    add_origin(parser)
    add_timeout(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR", help="folder for the files")
    parser.set_defaults(run=_kernel)


def command_for(options: argparse.Namespace, catalog: Catalog, variant: Variant, precision: Precision) -> str:
    """Return the command, without --language and -o, that writes a variant's program for the options' surface.

    The knobs are named that have another value than their default.
    """
    defaults = {parameter.name: parameter.default for parameter in catalog.get(variant.method).method.parameters}
    turned = [f"{name}={value!r}" for name, value in variant.parameters if value != defaults[name]]
    words = ["firsthit", "kernel", *surface_words(options), "--method", variant.method]
    words += [word for knob in turned for word in ("--knob", knob)]
    words += [] if precision == "float32" else ["--precision", precision]
    words += ["--plugins", str(options.plugins)] if options.plugins else []
    return shell(words)


def _kernel(options: argparse.Namespace) -> int:
    if options.language == "wgsl":
        raise FirsthitError(NO_WGSL)
    surface, catalog = surface_of(options), methods_of(options)
    variant = given_variant(options, catalog)
    info = usable_device(options.device) if options.device is not None else None
    if info and options.precision == "float64" and not info.float64:
        raise FirsthitError(f"{info.name} has no float64; take another device or --precision float32")
    device = info.name if info else None
    language = NAMED[options.language] if device is None else LANGUAGES[device.partition(":")[0]]
    shipment = Shipment(catalog.get(options.method), variant, surface, language, options.precision, options.origin)
    where = f"--language {options.language}" if device is None else f"--device {device}"
    origin = "" if options.origin == "nearest" else f" --origin {options.origin}"
    command = f"{command_for(options, catalog, variant, options.precision)} {where}{origin} -o DIR"
    files = package(shipment, command)
    tried = None if device is None else try_on(shipment, device, options.timeout)
    write_new(options.output, files)
    for name in files:
        print(f"made  {options.output / name}")
    if tried:
        print(
            f"tried on {device}: compiled in {tried.compile_ms / 1e3:.2g} s; {plural(tried.rays, 'ray')}, "
            f"{plural(tried.hits, 'hit')}, all answered as by the program that firsthit checks, to the last bit"
        )
    print(f"next:  {shell(['python', str(options.output / 'draw.py'), 'surface.png'])}")
    return 0
