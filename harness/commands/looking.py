"""devices, list, show: what is there, and what it looks like."""

from __future__ import annotations

import argparse
import tomllib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness import console
from harness.camera import camera_for, rays_of
from harness.commands.options import add_method, add_surface, cast, surface_of, writable
from harness.contract import DeviceInfo, FirsthitError, RayStatus, View
from harness.environment import ROOT, probed
from harness.executor import START_SECONDS, LocalExecutor, discover_devices
from harness.plugins import find_methods
from harness.runner import headlight
from harness.store import write_atomically

BACKGROUND = np.array([1.0, 1.0, 1.0])
LIT = np.array([0.36, 0.58, 0.82])
EXHAUSTED = np.array([0.84, 0.37, 0.0])


def add_parsers(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    text = "the devices of this machine and what their arithmetic and clocks are worth"
    parser = commands.add_parser("devices", help=text, description=text, epilog="example: firsthit devices")
    parser.set_defaults(run=_devices)

    text = "what there is to choose from"
    parser = commands.add_parser("list", help=text, description=text, epilog="example: firsthit list surfaces")
    parser.add_argument("what", choices=["methods", "surfaces", "configs", "devices"])
    parser.set_defaults(run=_list)

    text = "draw a shaded picture"
    parser = commands.add_parser(
        "show",
        help=text,
        description=text,
        epilog="example: firsthit show --surface torus --method newton -o a.png",
    )
    add_surface(parser)
    add_method(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=".png file to write")
    parser.add_argument("--size", type=int, default=512, help="pixels per side (default: 512)")
    parser.add_argument("--view", default="30,30", metavar="AZ,EL", help="angles in degrees (default: 30,30)")
    parser.add_argument("--fov", type=float, default=30.0, help="full vertical angle in degrees (default: 30)")
    parser.set_defaults(run=_show)


def _share(value: float | None) -> str:
    return "-" if value is None else f"{value:.2%}".replace(".00%", "%")


def _device_row(executor: LocalExecutor, info: DeviceInfo) -> tuple[str, ...]:
    info, probes = probed(executor, info)
    units = "-" if info.compute_units is None else str(info.compute_units)
    head = (info.name, info.title, info.driver, units, "yes" if info.float64 else "no")
    if not probes:
        return (*head, *["-"] * 7)
    shares = ("two_sum", "two_prod_fma", "two_prod_split", "round_to_nearest", "division")
    return (*head, info.clock, *(_share(probes[key]) for key in shares), f"{probes['peak_gflops']:.3g}")


def _devices(_options: argparse.Namespace) -> int:
    found = discover_devices()
    executor = LocalExecutor(START_SECONDS)
    try:
        rows = [_device_row(executor, info) for info in found]
    finally:
        executor.close()
    header = (
        "name",
        "title",
        "driver",
        "units",
        "float64",
        "clock",
        "two_sum",
        "two_prod fma",
        "two_prod split",
        "nearest",
        "division",
        "GFLOP/s",
    )
    print(console.table(header, rows))
    for info in found:
        if info.problem:
            print(f"{info.name}: {info.problem}")
    return 0 if any(not info.problem for info in found) else 3


def _list(options: argparse.Namespace) -> int:
    listing = {"methods": _methods, "surfaces": _surfaces, "configs": _configs, "devices": _device_names}
    print(listing[options.what](options))
    return 0


def _methods(options: argparse.Namespace) -> str:
    catalog = find_methods(options.plugins)
    rows = []
    for name, plugin in sorted(catalog.plugins.items()):
        knobs = ", ".join(f"{p.name}={p.default:g}" for p in plugin.method.parameters)
        rows.append((name, plugin.method.source, knobs or "-", ", ".join(sorted(plugin.method.claims)) or "-"))
    broken = [f"{name}: cannot be loaded: {reason}" for name, reason in catalog.broken.items()]
    return "\n".join([console.table(("name", "source", "parameters", "claims"), rows), *broken])


def _surfaces(_options: argparse.Namespace) -> str:
    import surfaces

    chosen = [surfaces.get(name) for name in surfaces.names()]
    rows = [(s.name, "-" if s.degree is None else s.degree, s.title, s.source) for s in chosen]
    return console.table(("name", "degree", "title", "source"), rows)


def _configs(_options: argparse.Namespace) -> str:
    rows = []
    for path in sorted((ROOT / "configs").glob("*.toml")):
        rows.append((path.relative_to(ROOT).as_posix(), tomllib.loads(path.read_text(encoding="utf-8"))["title"]))
    return console.table(("config", "title"), rows)


def _device_names(_options: argparse.Namespace) -> str:
    rows = [(info.name, info.title, info.problem or "usable") for info in discover_devices()]
    return console.table(("name", "title", "state"), rows)


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


def _show(options: argparse.Namespace) -> int:
    try:
        from PIL import Image
    except ImportError:
        raise FirsthitError("`firsthit show` needs the package pillow: pip install pillow") from None
    import io

    view, surface, output = _view(options), surface_of(options), writable(options.output)
    doubled = 2 * options.size
    rays = rays_of(camera_for(view, surface), doubled)
    hits = cast(options, surface, rays)
    colours = _colours(headlight(surface, rays, hits), hits.status).reshape(options.size, 2, options.size, 2, 3)
    picture = Image.fromarray(np.round(255.0 * colours.mean(axis=(1, 3))).astype(np.uint8))
    buffer = io.BytesIO()
    picture.save(buffer, "png")
    write_atomically(output, buffer.getvalue())
    exhausted = int((hits.status == RayStatus.EXHAUSTED).sum())
    print(f"{output}: {np.mean(hits.status == RayStatus.HIT):.1%} of {len(rays)} rays hit, {exhausted} exhausted")
    return 0


def _colours(shade: NDArray[np.float32], status: NDArray[np.uint8]) -> NDArray[np.float64]:
    """float64[n, 3] in [0, 1]: headlight shading, white background, exhausted rays in orange."""
    lit = LIT * (0.25 + 0.75 * np.nan_to_num(shade)[:, None])
    colours = np.where((status == RayStatus.HIT)[:, None], lit, BACKGROUND)
    colours[status == RayStatus.EXHAUSTED] = EXHAUSTED
    return colours
