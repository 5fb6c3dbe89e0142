"""show, sheet: what surfaces look like."""

from __future__ import annotations

import argparse
import io
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.answers import invalid
from harness.accuracy.pictures import headlight
from harness.commands import Add
from harness.commands.options import add_method, add_surface, cast, surface_of, writable
from harness.contract import FirsthitError, Hits, RayStatus, Surface, View
from harness.results.store import write_atomically
from harness.scenes.camera import camera_for, rays_of

if TYPE_CHECKING:
    from PIL.Image import Image

BACKGROUND = np.array([1.0, 1.0, 1.0])
LIT = np.array([0.36, 0.58, 0.82])
EXHAUSTED = np.array([0.84, 0.37, 0.0])
INVALID = np.array([1.0, 0.0, 1.0])


def add_parsers(add: Add) -> None:
    parser = add("show", "firsthit show --surface torus --method newton -o a.png")
    add_surface(parser)
    add_method(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=".png file to write")
    parser.add_argument("--size", type=int, default=512, help="pixels per side (default: 512)")
    parser.add_argument("--view", default="30,30", metavar="AZ,EL", help="angles in degrees (default: 30,30)")
    parser.add_argument("--fov", type=float, default=30.0, help="full vertical angle in degrees (default: 30)")
    parser.set_defaults(run=_show)

    parser = add("sheet", "firsthit sheet --method ray_march -o sheet.png")
    add_method(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=".png file to write")
    parser.add_argument("--size", type=int, default=160, help="pixels per side of each picture (default: 160)")
    parser.add_argument("--columns", type=int, default=8, help="pictures side by side (default: 8)")
    parser.set_defaults(run=_sheet, view="30,30", fov=30.0)


def _view(options: argparse.Namespace) -> View:
    try:
        azimuth, elevation = (float(part) for part in options.view.split(","))
    except ValueError:
        raise FirsthitError(f"--view {options.view!r}: write azimuth,elevation in degrees, as in 30,30") from None
    if not (1 <= options.size <= 8192):
        raise FirsthitError(f"--size {options.size}: an image has 1 to 8192 pixels per side")
    if not (0.0 < options.fov < 180.0):
        raise FirsthitError(f"--fov {options.fov:g}: the angle lies between 0 and 180 degrees")
    return View("shown", azimuth=azimuth, elevation=elevation, fov=options.fov)


def need_pillow() -> None:
    """Raise where the one package that pictures need is missing, before any work is done."""
    import importlib.util

    if not importlib.util.find_spec("PIL"):
        raise FirsthitError("pictures need the package pillow: pip install pillow")


def _picture(options: argparse.Namespace, surface: Surface, view: View) -> tuple[Image, Hits]:
    """A shaded picture, four rays to a pixel, and the rays' hits."""
    from PIL import Image

    camera = camera_for(view, surface)
    rays = rays_of(camera, 2 * options.size)
    hits = cast(options, surface, rays, camera)
    colours = _colours(headlight(surface, rays, hits), hits.status).reshape(options.size, 2, options.size, 2, 3)
    return Image.fromarray(np.round(255.0 * colours.mean(axis=(1, 3))).astype(np.uint8)), hits


def save(picture: Image, output: Path) -> None:
    buffer = io.BytesIO()
    picture.save(buffer, "png", optimize=True)
    write_atomically(output, buffer.getvalue())


def _show(options: argparse.Namespace) -> int:
    need_pillow()
    view, surface, output = _view(options), surface_of(options), writable(options.output)
    picture, hits = _picture(options, surface, view)
    save(picture, output)
    exhausted = int((hits.status == RayStatus.EXHAUSTED).sum())
    told = f"{np.mean(hits.status == RayStatus.HIT):.1%} of {len(hits.t)} rays hit, {exhausted} exhausted"
    bad = invalid(hits)
    print(f"{output}: {told}" + (f", {bad} invalid" if bad else ""))
    return 0


def _sheet(options: argparse.Namespace) -> int:
    need_pillow()
    from PIL import Image, ImageDraw

    import surfaces

    view, output, names = _view(options), writable(options.output), surfaces.names()
    label, columns = 14, max(1, options.columns)
    width, height = options.size, options.size + label
    sheet = Image.new("RGB", (columns * width, math.ceil(len(names) / columns) * height), "white")
    draw = ImageDraw.Draw(sheet)
    for i, name in enumerate(names):
        x, y = (i % columns) * width, (i // columns) * height
        picture, _ = _picture(options, surfaces.get(name), view)
        sheet.paste(picture, (x, y))
        draw.text((x + width // 2, y + options.size + label // 2), name, fill="black", anchor="mm")
    save(sheet, output)
    print(f"{output}: {len(names)} surfaces")
    return 0


def _colours(shade: NDArray[np.float32], status: NDArray[np.uint8]) -> NDArray[np.float64]:
    """float64[n, 3] in [0, 1]: headlight shading, white background; exhausted rays orange, invalid ones magenta."""
    lit = LIT * (0.25 + 0.75 * np.nan_to_num(shade)[:, None])
    colours = np.where((status == RayStatus.HIT)[:, None], lit, BACKGROUND)
    colours[status == RayStatus.EXHAUSTED] = EXHAUSTED
    colours[status == RayStatus.INVALID] = INVALID
    return colours
