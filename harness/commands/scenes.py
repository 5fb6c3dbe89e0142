"""scene: what a config's scenes look like."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from harness.accuracy.answers import invalid
from harness.accuracy.scene_truth import hits_of
from harness.commands import Add
from harness.commands.options import add_origin, given_variant, writable_png
from harness.commands.pictures import need_pillow, save
from harness.contract import PROXIES, FirsthitError
from harness.devices.discovery import discover_devices
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.frames import RasterCheck, RasterFrame
from harness.experiment import reading
from harness.experiment.kinds import draws
from harness.experiment.shipped import located
from harness.experiment.targets import able
from harness.kernels.raster import fill_program
from harness.plugins import find_methods
from harness.scenes.camera import camera_for
from harness.scenes.model import Scene
from harness.scenes.records import depth_map
from surfaces.words import suggestion


def add_parsers(add: Add) -> None:
    parser = add("scene", "firsthit scene configs/pipes.toml --name 'pipes 2000' --method newton -o pipes.png")
    parser.add_argument(
        "config", type=Path, metavar="CONFIG", help="a TOML file with [scene.NAME] tables, or a config's name"
    )
    parser.add_argument("--name", metavar="NAME", help="which scene, as `firsthit plan` names it (default: the first)")
    parser.add_argument("--method", required=True, metavar="NAME", help="of instances without a method of their own")
    parser.add_argument("--knob", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the method")
    parser.add_argument("--proxy", choices=PROXIES, default="box", help="what triggers fragments (default: box)")
    add_origin(parser)
    parser.add_argument("--size", type=int, default=512, help="pixels per side (default: 512)")
    parser.add_argument("--timeout", type=float, default=60.0, metavar="SECONDS", help="give up after (default: 60)")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=".png file to write")
    parser.set_defaults(run=_scene)


def _chosen(scenes: tuple[Scene, ...], name: str | None, path: Path) -> Scene:
    if not scenes:
        raise FirsthitError(f"{path} has no scenes; see configs/pipes.toml for how they are stated")
    names = {scene.name: scene for scene in scenes}
    if name is not None and name not in names:
        raise FirsthitError(f"{path} has no scene {name!r}; {suggestion(name, names)}")
    return names[name] if name else scenes[0]


def _scene(options: argparse.Namespace) -> int:
    need_pillow()
    from PIL import Image

    if not 1 <= options.size <= 8192:
        raise FirsthitError(f"--size {options.size}: an image has 1 to 8192 pixels per side")
    output, catalog = writable_png(options.output), find_methods(options.plugins)
    path = located(options.config)
    scene = _chosen(reading.load(path, catalog).scenes, options.name, path)
    variant = given_variant(options, catalog)
    if reason := draws.refusal(scene, variant, catalog):
        raise FirsthitError(f"{variant} cannot draw {scene.name}: {reason}")
    usable = [info.name for info in discover_devices() if able(info) and not info.problem]
    if not usable:
        raise FirsthitError("no device that rasterises; `firsthit devices` says what is here", exit_code=3)
    camera = camera_for(scene.view, scene.stand_in)
    batches = tuple(
        draw.batch(True) for draw in draws.draws(scene, variant, options.proxy, catalog, origin=options.origin)
    )
    depths, side = depth_map(scene, camera), 2 * options.size
    executor = LocalExecutor(options.timeout)
    try:
        frame = RasterFrame(batches, camera, depths, side)
        picture = executor.check(usable[0], RasterCheck(frame, fill_program())).answer
    except CellError as error:
        raise FirsthitError(f"{variant} on {usable[0]}: {error}", exit_code=3) from None
    finally:
        executor.close()
    colours = np.where((picture.batch >= 0)[:, None], picture.colours[:, :3], np.uint8(255)).astype(np.float64)
    four = colours.reshape(options.size, 2, options.size, 2, 3)
    save(Image.fromarray(np.round(four.mean(axis=(1, 3))).astype(np.uint8)), output)
    fragments, hits = int(picture.fragments.sum(dtype=np.int64)), int(picture.fragment_hits.sum(dtype=np.int64))
    print(
        f"{output}: {scene.title}; {np.mean(picture.batch >= 0):.1%} of the pixels drawn, "
        f"{1.0 - hits / max(1, fragments):.1%} of {fragments:,} fragments discarded"
        + (f", {bad} pixels invalid" if (bad := invalid(hits_of(scene, picture, options.origin))) else "")
    )
    return 0
