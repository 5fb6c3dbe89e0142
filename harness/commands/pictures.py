"""Offer `firsthit show` and `sheet`: pictures of surfaces."""

from __future__ import annotations

import argparse
import io
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from harness import memory
from harness.accuracy.answers import invalid
from harness.commands import Add
from harness.commands.options import (
    add_method,
    add_surface,
    caster_of,
    number,
    surface_of,
    tell,
    whole,
    writable_png,
)
from harness.contract import FirsthitError, RayStatus, Surface, View, plural
from harness.limits import FIELD_OF_VIEW, PICTURE, Within
from harness.results.writing import write_atomically
from harness.running.picture import picture
from surfaces import AUTO, reading
from surfaces.model import domain_text
from surfaces.proofs.extent import remark

if TYPE_CHECKING:
    from PIL.Image import Image


COLUMNS = Within(1, 1000)
BYTES_PER_PIXEL = 6  # of a sheet: three while it is drawn, and as many for the file
ANY_SURFACE = "interval_march"  # a method that draws whatever can be read


def add_parsers(add: Add) -> None:
    told = "Draw a shaded picture. Without -o, print how the surface is read and draw nothing."
    parser = add("show", "firsthit show --surface torus --method newton -o a.png", told)
    add_surface(parser)
    add_method(parser, default=ANY_SURFACE)
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help=".png file to write")
    parser.add_argument("--size", type=whole(PICTURE), default=512, help="pixels per side (default: 512)")
    parser.add_argument("--view", default="30,30", metavar="AZ,EL", help="angles in degrees (default: 30,30)")
    parser.add_argument("--fov", type=number(FIELD_OF_VIEW), default=30.0, help="full vertical angle (default: 30)")
    parser.set_defaults(run=_show)

    parser = add("sheet", "firsthit sheet --method ray_march -o sheet.png")
    add_method(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=".png file to write")
    parser.add_argument("--size", type=whole(PICTURE), default=160, help="pixels per side of each (default: 160)")
    parser.add_argument("--columns", type=whole(COLUMNS), default=8, help="pictures side by side (default: 8)")
    parser.add_argument(
        "--group",
        default="catalog",
        help="catalog, gallery, or one of the gallery's groups, see `firsthit list surfaces`",
    )
    parser.set_defaults(run=_sheet, view="30,30", fov=30.0)


def _view(options: argparse.Namespace) -> View:
    """Return the view that the options name. Raises FirsthitError for a text that is no two angles of a view."""
    try:
        azimuth, elevation = (float(part) for part in options.view.split(","))
    except ValueError:
        raise FirsthitError(f"--view {options.view!r}: write azimuth,elevation in degrees, as in 30,30") from None
    return View("shown", azimuth=azimuth, elevation=elevation, fov=options.fov)


def need_pillow() -> None:
    """Raise FirsthitError where the one package that picture files need is missing, before any work is done."""
    import importlib.util

    if not importlib.util.find_spec("PIL"):
        raise FirsthitError("pictures need the package pillow: pip install pillow")


def save(image: Image, output: Path) -> None:
    """Write an image as a PNG file, whole or not at all. Raises FirsthitError where it cannot be written."""
    buffer = io.BytesIO()
    image.save(buffer, "png", optimize=True)
    write_atomically(output, buffer.getvalue())


def _show(options: argparse.Namespace) -> int:
    view, surface = _view(options), surface_of(options)
    if options.output is None:
        print("\n".join(_read(surface)))
        return 0
    need_pillow()
    from PIL import Image

    output = writable_png(options.output)
    pixels, hits = picture(caster_of(options), surface, view, options.size, tell)
    save(Image.fromarray(pixels), output)
    exhausted = int((hits.status == RayStatus.EXHAUSTED).sum())
    told = f"{np.mean(hits.status == RayStatus.HIT):.1%} of {plural(len(hits.t), 'ray')} hit, {exhausted} exhausted"
    bad = invalid(hits)
    print(f"{output}: {told}" + (f", {bad} invalid" if bad else ""))
    for line in reading(surface).told() if options.formula is not None else ():
        print(line)
    if options.domain == AUTO:
        print(f"domain: {domain_text(surface.domain)}")
    return 0


def _read(surface: Surface) -> list[str]:
    """Return lines that say how a surface is read, and how it lies in its domain."""
    found = reading(surface)
    degree = "no polynomial" if surface.degree is None else f"a polynomial of degree {surface.degree}"
    distance = {None: "none is proved or stated", surface.formula: "the formula itself is one"}
    lines = [f"read as: {found.canonical}", *(f"note: {note}" for note in found.notes), f"kind: {degree}"]
    lines += [f"domain: {domain_text(surface.domain)}"]
    lines += [f"distance bound: {distance.get(surface.distance, surface.distance)}"]
    return [*lines, *filter(None, [remark(surface)])]


def _sheet(options: argparse.Namespace) -> int:
    need_pillow()
    from PIL import Image, ImageDraw

    import surfaces

    view, output, names = _view(options), writable_png(options.output), surfaces.names(options.group)
    caster = caster_of(options)
    label, columns = 14, options.columns
    width, height = options.size, options.size + label
    area = columns * width * math.ceil(len(names) / columns) * height
    what = f"a sheet of {plural(len(names), 'picture')} of {options.size}x{options.size} pixels"
    if reason := memory.refusal(BYTES_PER_PIXEL * area, what, "take a smaller --size"):
        raise FirsthitError(reason, exit_code=3)
    sheet = Image.new("RGB", (columns * width, math.ceil(len(names) / columns) * height), "white")
    draw = ImageDraw.Draw(sheet)
    for i, name in enumerate(names):
        x, y = (i % columns) * width, (i // columns) * height
        pixels, _ = picture(caster, surfaces.get(name), view, options.size, tell)
        sheet.paste(Image.fromarray(pixels), (x, y))
        draw.text((x + width // 2, y + options.size + label // 2), name, fill="black", anchor="mm")
    save(sheet, output)
    print(f"{output}: {plural(len(names), 'surface')}")
    return 0
