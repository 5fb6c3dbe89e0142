"""Options that several commands share, and what they stand for."""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import compilers
from harness.accuracy.answers import validated, validated_beams
from harness.contract import ORIGINS, PRECISIONS, CellStatus, FirsthitError, Hits, Precision, Program, Surface, Variant
from harness.devices.executor import CellError, LocalExecutor, discover_devices
from harness.devices.interface import LANGUAGES, no_device
from harness.devices.quadtree import layout_of
from harness.devices.worker import Frame
from harness.kernels.assemble import Language, method_program
from harness.plugins import Catalog, find_methods


def add_surface(parser: argparse.ArgumentParser) -> None:
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--surface", metavar="NAME", help="a surface of the catalog, see `firsthit list surfaces`")
    which.add_argument("--formula", metavar="F", help="f(x, y, z) of your own, as in 'x^2 + y^2*z^3 - z^4'")
    parser.add_argument("--domain", metavar="D", help="sphere:R or box:X,Y,Z (half extents); default sphere:1.5")
    parser.add_argument("--parameter", action="append", default=[], metavar="NAME=VALUE", help="of the surface")


def add_method(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--method", required=True, metavar="NAME", help="see `firsthit list methods`")
    parser.add_argument("--knob", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the method")
    parser.add_argument("--device", metavar="NAME", help="see `firsthit list devices`; default: the first usable one")
    parser.add_argument("--precision", choices=PRECISIONS, default="float32")
    add_origin(parser)
    parser.add_argument("--timeout", type=float, default=60.0, metavar="SECONDS", help="give up after (default: 60)")


def add_origin(parser: argparse.ArgumentParser) -> None:
    help_ = "where the method sees its rays begin: nearest the domain's centre (default), at their entry, at the eye"
    parser.add_argument("--origin", choices=ORIGINS, default="nearest", help=help_)


def _assignments(texts: list[str], option: str) -> dict[str, str]:
    pairs = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            raise FirsthitError(f"{option} {text!r}: write NAME=VALUE")
        pairs[name.strip()] = value.strip()
    return pairs


def surface_of(options: argparse.Namespace) -> Surface:
    """The surface that --surface or --formula names."""
    import surfaces

    parameters = _assignments(options.parameter, "--parameter")
    if options.surface:
        if options.domain:
            raise FirsthitError("--domain goes with --formula; a surface of the catalog has its own")
        return surfaces.get(options.surface, **parameters)
    return surfaces.from_formula(options.formula, options.domain or "sphere:1.5", parameters=parameters)


def _number(text: str, name: str) -> float | int:
    try:
        value = float(text)
    except ValueError:
        raise FirsthitError(f"--knob {name}={text}: not a number") from None
    return int(value) if value.is_integer() and "." not in text and "e" not in text.lower() else value


def given_variant(options: argparse.Namespace, catalog: Catalog) -> Variant:
    """The method that --method names, with the knobs that --knob turns."""
    given = _assignments(options.knob, "--knob")
    return catalog.get(options.method).variant({name: _number(text, name) for name, text in given.items()})


def _device(name: str | None) -> str:
    if name:
        return name
    usable = [info.name for info in discover_devices() if not info.problem]
    if not usable:
        raise FirsthitError("no usable device; `firsthit devices` says why", exit_code=3)
    return usable[0]


def cast(
    options: argparse.Namespace,
    surface: Surface,
    rays: NDArray[np.float32],
    camera: NDArray[np.float32] | None = None,
    t_min: float = 0.0,
) -> Hits:
    """Cast rays float32[n, 6] from t_min on, by the method, knobs, device and precision that the options name.

    A method that casts beams needs the `camera` that the rays are of, an image of them row by row, and answers for the
    rays' pixels. What can be no answer is INVALID. The device works in a process of its own. Raises FirsthitError where
    the method refuses the surface, the kernel fails, hangs, crashes or answers otherwise when it is run again, or the
    device's compiler is found at fault (harness/accuracy/compilers.py).
    """
    from harness.kernels.functions import unsupported

    catalog = find_methods(options.plugins)
    plugin, variant = catalog.get(options.method), given_variant(options, catalog)
    precision: Precision = options.precision
    device = _device(options.device)
    language = LANGUAGES.get(device.partition(":")[0])
    if language is None:
        raise no_device(device, discover_devices())
    if reason := plugin.method.accepts(surface) or unsupported(surface, precision, language):
        raise FirsthitError(f"{variant} cannot draw {surface.name} here: {reason}")
    casts = plugin.method.casts
    if casts == "mesh":
        raise FirsthitError(f'{variant} draws triangles, in stage raster: name it in a config with stages = ["raster"]')
    if casts != "rays" and camera is None:
        raise FirsthitError(f"{variant} casts the beams of a camera's pixels, and listed rays have none")
    entry: Literal["rays", "beams"] = "rays" if casts == "rays" else "beams"

    def program(language: Language) -> Program:
        stated = plugin.method, plugin.folder, variant, surface, precision, language, entry
        return method_program(*stated, t_min=t_min, origin=options.origin)

    def run(device: str, program: Program, index: NDArray[np.intp]) -> Hits:
        if camera is None or casts == "rays":
            return executor.check(device, program, rays[index]).hits
        layout = layout_of(dict(variant.parameters))
        frame = Frame(program, camera, None, math.isqrt(len(rays)), casts, layout=layout)
        return executor.check_frame(device, frame, index.astype(np.int32)).hits

    executor = LocalExecutor(options.timeout)
    try:
        hits = run(device, program(language), np.arange(len(rays)))
        if camera is not None and casts != "rays":
            hits = validated_beams(hits, surface.domain, rays, camera[3:6])
        else:
            hits = validated(hits, surface.domain, rays, t_min, origin=options.origin)
        if not plugin.method.answers:
            return hits
        second = compilers.SecondBuild(device, precision, program, run)
        doubts = compilers.doubts_about(surface, rays, hits, second, t_min)
    except CellError as error:
        what = {CellStatus.TIMEOUT: "timed out", CellStatus.CRASHED: "crashed"}.get(error.status, "failed")
        raise FirsthitError(f"{variant} on {device} {what}: {error}", exit_code=3) from None
    finally:
        executor.close()
    if doubts.fault:
        raise FirsthitError(f"{variant} on {device}: {doubts.fault}", exit_code=3)
    if doubts.note:
        print(f"{variant} on {surface.name}: {doubts.note}", file=sys.stderr)
    return hits


def writable(path: Path) -> Path:
    """`path`, if a file can be put there; asked before long work, so that nothing finished is lost."""
    if path.is_dir() or not path.parent.is_dir():
        raise FirsthitError(f"cannot write {path}: {'it is a folder' if path.is_dir() else 'no such folder'}")
    return path
