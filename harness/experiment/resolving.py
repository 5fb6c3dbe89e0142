"""Resolve the names of a config: find the methods, surfaces, scenes and views that they stand for."""

from __future__ import annotations

import contextlib
import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError, Surface, Variant, View
from harness.experiment.config import (
    ASKED,
    BESIDE_INCLUDE,
    DRAWN,
    Config,
    Experiment,
    MethodChoice,
    SurfaceChoice,
    views_of,
)
from harness.experiment.toml_file import ConfigFile, Where, gathered
from harness.limits import Distinct, Known
from harness.plugins import Catalog, Plugin
from harness.scenes.choice import cut, scenes_of
from harness.scenes.model import Scene
from harness.scenes.views import along_path, by_angle, by_direction
from surfaces.words import name_problem

MOST_VARIANTS = 100_000  # of one method
MOST_PARTS = 2_000_000  # of all scenes of a config


def resolve(config: Config, file: ConfigFile, catalog: Catalog) -> Experiment:
    """Resolve every name that a config holds. Raises FirsthitError with file and line for each that is not there."""
    if problem := name_problem(file.path.stem):
        raise file.error((), f"the config's file gives its run the name, and {problem}")
    if config.include:
        return _collection(config, file)
    config = _with_all_families(_with_all_views(config, file))
    _check_that_something_is_asked(config, file)
    told: list[str] = []
    parts: list[Callable[[], Any]] = [
        lambda: _variants(config, file, catalog),
        lambda: _surfaces(config, file, told),
        lambda: _scenes(config, file, catalog, told),
    ]
    (variants, own), chosen, scenes = gathered(parts, lambda part: part())
    _check_named(config, file, catalog, variants)
    _check_told_apart(config, file, chosen, scenes)
    return Experiment(
        file.path.stem,
        file.path,
        file.text,
        config,
        tuple(variants),
        tuple(chosen),
        tuple(config.precisions),
        tuple(config.stages),
        prepasses=tuple(config.prepass),
        origins=tuple(config.origins),
        proxies=tuple(config.proxies),
        normals=tuple(config.normals),
        scenes=tuple(scenes),
        own_stages={variant: tuple(choice.stages) for variant, choice in own.items() if choice.stages},
        own_devices={variant: tuple(choice.devices) for variant, choice in own.items() if choice.devices},
        left_out=tuple(dict.fromkeys(told)),
    )


def _collection(config: Config, file: ConfigFile) -> Experiment:
    """Make the experiment of a config that includes others, whose paths are relative to its own folder.

    Raises FirsthitError where it states more than a title beside them, or where there is no such config.
    """
    if more := [key for key in file.table if key not in BESIDE_INCLUDE]:
        message = f"{more[0]} cannot stand beside include; put it into one of the configs included"
        raise file.error((more[0],), message)
    paths = [file.path.parent / name for name in config.include]
    stems = {file.path.stem: "this config"}
    for i, included in enumerate(paths):
        if not included.is_file():
            raise file.error(("include", i), f"include: there is no config {included}")
        if other := stems.get(included.stem):
            message = f"include: {included} would be run into the folder of {other}, {included.stem!r}; rename one"
            raise file.error(("include", i), message)
        stems[included.stem] = str(included)
    return Experiment(file.path.stem, file.path, file.text, config, (), (), (), (), tuple(paths))


def _with_all_views(config: Config, file: ConfigFile) -> Config:
    """Add the views of `angles`, `directions` and `path`.

    Raises FirsthitError where two have one name, or show the same, and where the path cannot be gone.
    """
    views = [*config.view]
    views += by_angle(config.angles) if config.angles else []
    views += by_direction(config.directions) if config.directions else []
    if config.path:
        with _placed(file, ("path",)):
            views += along_path(config.path)
    if problem := Distinct().broken([view.name for view in views]):
        raise file.error(("view",), f"view: {problem}")
    seen: dict[View, str] = {}
    for i, view in enumerate(views):
        unnamed = dataclasses.replace(view, name="any", azimuth=view.azimuth % 360.0)
        if other := seen.get(unnamed):
            where: Where = ("view", i) if i < len(config.view) else (view.set or "view",)
            raise file.error(where, f"view: {other!r} and {view.name!r} are the same but for the name; keep one")
        seen[unnamed] = view.name
    return dataclasses.replace(config, view=views or [View("default")])


def _with_all_families(config: Config) -> Config:
    from harness import hardcases

    return dataclasses.replace(config, families=list(hardcases.names())) if config.families == ["all"] else config


def _check_that_something_is_asked(config: Config, file: ConfigFile) -> None:
    """Raise FirsthitError where the config names nothing to draw or compute, or no method to draw by."""
    if not any(getattr(config, name) for name in ASKED):
        message = "name surfaces to draw, or scenes, or families of hard rays, or studies, or some of each"
        raise file.error((), message)
    if any(getattr(config, name) for name in DRAWN) and not config.method:
        raise file.error((), "the top level lacks 'method'")


def _variants(config: Config, file: ConfigFile, catalog: Catalog) -> tuple[list[Variant], dict[Variant, MethodChoice]]:
    """Bind every method's knobs.

    Returns all variants, and what the config says of each one's method. Raises FirsthitError for an unknown method or
    knob, and where a variant is named twice.
    """

    def of(one: tuple[int, MethodChoice]) -> list[Variant]:
        where: Where = ("method", one[0])
        with _placed(file, (*where, "name")):
            plugin = catalog.get(one[1].name, file.path.parent)
        return _variants_of(one[1], plugin, file, where)

    chosen = gathered(enumerate(config.method), of)
    bound, labels = dict[Any, Variant](), dict[str, Variant]()
    for i, variant in ((i, variant) for i, own in enumerate(chosen) for variant in own):
        first = bound.setdefault((variant.method, variant.parameters), variant)
        if first is not variant:
            raise file.error(("method", i), f"{variant} is named twice{_also(first, variant)}")
        if labels.setdefault(str(variant), variant) is not variant:
            message = f"two variants would both be called {variant}; give values that differ in their first six digits"
            raise file.error(("method", i), message)
    variants = [variant for own in chosen for variant in own]
    return variants, {v: choice for choice, own in zip(config.method, chosen, strict=True) for v in own}


def _also(first: Variant, variant: Variant) -> str:
    return "" if str(first) == str(variant) else f": {first} has the same values"


@contextlib.contextmanager
def _placed(file: ConfigFile, where: Where) -> Iterator[None]:
    """Add to a FirsthitError that a block raises the file and the line of the value at `where`."""
    try:
        yield
    except FirsthitError as error:
        raise file.error(where, str(error), error.exit_code) from None


def _variants_of(choice: MethodChoice, plugin: Plugin, file: ConfigFile, where: Where) -> list[Variant]:
    """Bind the knobs of the method at `where`: its settings, its deviations, every combination of the values given.

    Raises FirsthitError, with file and line, for a setting or knob that there is not, and for a value that it cannot
    have.
    """
    variants, alone = list[Variant](), list[Variant]()
    for i, name in enumerate(choice.settings):
        with _placed(file, (*where, "settings", i)):
            variants.append(plugin.setting(name))
    for name, values in choice.parameters.items():
        for i, value in enumerate(values):
            with _placed(file, (*where, "parameters", name, i)):
                alone.append(plugin.variant({name: value}))
    with _placed(file, (*where, "parameters")):
        if (count := math.prod(map(len, choice.parameters.values()))) > MOST_VARIANTS:
            raise FirsthitError(f"the values of its knobs make {count:,} variants; {MOST_VARIANTS:,} at most")
    variants += plugin.deviations() if choice.deviations else []
    if choice.parameters or not variants:
        is_one = len(choice.parameters) == 1
        variants += alone if is_one else [plugin.variant(point) for point in _grid(choice.parameters)]
    return variants


def _grid(parameters: Mapping[str, list[float]]) -> list[dict[str, float]]:
    """Return every combination of the knobs' values; if no knob is given, a single one, which is empty."""
    grid: list[dict[str, float]] = [{}]
    for name, values in parameters.items():
        grid = [{**point, name: value} for point in grid for value in values]
    return grid


def _check_named(config: Config, file: ConfigFile, catalog: Catalog, variants: list[Variant]) -> None:
    """Raise FirsthitError where the config's baseline or focus is none of its own methods and variants.

    A method that finds nothing, and measures the harness, can be neither.
    """
    answering = [variant for variant in variants if catalog.get(variant.method).method.answers]
    known = dict.fromkeys([*(variant.method for variant in answering), *map(str, answering)])
    for name, given in (("baseline", config.baseline), ("focus", config.focus)):
        if name in file.table and (problem := Known(lambda: known).broken([given])):
            raise file.error((name,), f"{name}: {problem}")


def _check_told_apart(config: Config, file: ConfigFile, chosen: Sequence[Surface], scenes: Sequence[Scene]) -> None:
    """Raise FirsthitError where two surfaces are the same, or where two surfaces or scenes would be called the same."""
    seen: dict[Any, str] = {}
    for surface in chosen:
        known = seen.setdefault((surface.formula, surface.domain, surface.parameters, surface.distance), surface.name)
        if known != surface.name:
            message = f"surfaces: {known!r} and {surface.name!r} are the same but for the name; keep one"
            raise file.error(("surfaces",), message)
    if problem := Distinct().broken([scene.name for scene in scenes]):
        raise file.error(("scene",), f"scene: {problem}, by its generator and the count of its parts")
    places = [(surface.name, view.name) for surface in chosen for view in config.view]
    places += [(scene.name, view.name) for scene in scenes for view in views_of(scene, config)]
    if problem := Distinct(lambda both: [" ".join(one) for one in both]).broken(places):
        raise file.error(("scene" if scenes else "surfaces",), f"surfaces, scenes and views: {problem}")


def _surfaces(config: Config, file: ConfigFile, told: list[str]) -> list[Surface]:
    """Return the surfaces that the config names, of a group that it names all, and add to `told` as `_surface` does.

    "all" is the catalog. Raises FirsthitError for an unknown one and for a bad formula.
    """
    import surfaces
    from surfaces.entries import CATALOG

    groups = {"all": CATALOG, surfaces.GALLERY: surfaces.GALLERY} | {name: name for name in surfaces.groups()}
    chosen: list[Surface] = []
    named = [surfaces.names(groups[name]) if name in groups else (name,) for name in config.surfaces]
    for name in dict.fromkeys(name for own in named for name in own):
        try:
            chosen.append(_surface(name, {}, config, file.path.parent, told))
        except FirsthitError as error:
            stated = config.surface.get(name)
            where: Where = ("surface", name, "file" if stated.file else "formula") if stated else ("surfaces",)
            raise file.error(where, str(error)) from None
    return chosen


def _surface(
    name: str, parameters: Mapping[str, float | str], config: Config, folder: Path, told: list[str]
) -> Surface:
    """Return a surface of the config's own, of a file, or of the catalog, with `parameters` bound.

    Files are looked for from `folder`; what of them is not carried over is added to `told`. Raises FirsthitError where
    there is none, or where it cannot be made.
    """
    import surfaces

    stated = config.surface.get(name, SurfaceChoice())
    bound = {**stated.parameters, **parameters}
    given = {key: value if isinstance(value, str) else repr(value) for key, value in bound.items()}
    if stated.file:
        from surfaces import files

        if stated.formula:
            raise FirsthitError(f"surface {name!r} has a formula and a file; give one of them")
        found = files.load(folder / stated.file, stated.domain or None, dict(given), stated.distance or None)
        told += [f"{name}: {remark}" for remark in found.remarks]
        return dataclasses.replace(found.surface, name=name)
    if not stated.formula:
        if stated.distance:
            raise FirsthitError("a distance goes with a formula; a surface of the catalog has its own")
        return cut(surfaces.get(name, **given), stated.domain)
    return surfaces.from_formula(
        stated.formula, stated.domain or "sphere:1.5", name=name, parameters=given, distance=stated.distance or None
    )


def _scenes(config: Config, file: ConfigFile, catalog: Catalog, told: list[str]) -> list[Scene]:
    """Make the scenes that the config states, and add to `told` as `_surface` does.

    Raises FirsthitError, with the scene's line, if one cannot be made.
    """
    scenes: list[Scene] = []
    generated = [choice for choice in config.scene.values() if choice.generate]
    if (parts := sum(sum(choice.counts) for choice in generated)) > MOST_PARTS:
        raise file.error(("scene",), f"scene: {parts:,} parts in all scenes together; {MOST_PARTS:,} at most")
    for name, choice in config.scene.items():
        try:
            scenes += scenes_of(
                name,
                choice,
                lambda placed: cut(
                    _surface(placed.surface, placed.parameters, config, file.path.parent, told), placed.domain
                ),
                lambda placed: catalog.get(placed.method, file.path.parent).variant(placed.knobs),
            )
        except FirsthitError as error:
            raise file.error(("scene", name), str(error), error.exit_code) from None
    return scenes
