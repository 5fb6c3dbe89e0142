"""Offer `firsthit scene`: pictures of a config's scenes."""

from __future__ import annotations

import argparse
from pathlib import Path

from harness.commands import Add
from harness.commands.options import add_origin, add_timeout, given_variant, methods_of, whole, writable_png
from harness.commands.pictures import need_pillow, save
from harness.contract import PROXIES, FirsthitError, plural
from harness.experiment import reading
from harness.experiment.shipped import located
from harness.limits import PICTURE
from harness.plugins import Catalog
from harness.running.scene_picture import draw_scene
from harness.scenes.model import Scene
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
    parser.add_argument("--size", type=whole(PICTURE), default=512, help="pixels per side (default: 512)")
    add_timeout(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=".png file to write")
    parser.set_defaults(run=_scene)


def _chosen(scenes: tuple[Scene, ...], name: str | None, path: Path) -> Scene:
    """Return the scene of that name, or the first. Raises FirsthitError where the config at `path` has none such."""
    if not scenes:
        raise FirsthitError(f"{path} has no scenes; see configs/pipes.toml for how they are stated")
    names = {scene.name: scene for scene in scenes}
    if name is not None and name not in names:
        raise FirsthitError(f"{path} has no scene {name!r}; {suggestion(name, names)}")
    return scenes[0] if name is None else names[name]


def _need_methods(scene: Scene, catalog: Catalog) -> None:
    """Raise FirsthitError, with exit code 3, where a method that instances of the scene name cannot be loaded."""
    names = dict.fromkeys(group.variant.method for group in scene.groups if group.variant)
    for name in names:
        if (why := catalog.broken.get(name)) is not None:
            told = f"scene {scene.name!r} names the method {name!r}, which cannot be loaded: {why}"
            raise FirsthitError(told, exit_code=3)


def _scene(options: argparse.Namespace) -> int:
    """Draw a config's scene into a file.

    Methods of the config that cannot be loaded are no obstacle, unless the scene names one. Raises FirsthitError for
    that, and for a size that no image has.
    """
    need_pillow()
    from PIL import Image

    output, catalog = writable_png(options.output), methods_of(options)
    path = located(options.config)
    scene = _chosen(reading.load(path, catalog.with_stand_ins()).scenes, options.name, path)
    _need_methods(scene, catalog)
    variant = given_variant(options, catalog)
    picture = draw_scene(scene, variant, catalog, options.proxy, options.origin, options.size, options.timeout)
    save(Image.fromarray(picture.pixels), output)
    print(
        f"{output}: {scene.title}; {picture.drawn:.1%} of the pixels drawn, "
        f"{1.0 - picture.hits / max(1, picture.fragments):.1%} of {plural(picture.fragments, 'fragment')} discarded"
        + (f", {plural(picture.invalid, 'pixel')} invalid" if picture.invalid else "")
    )
    return 0
