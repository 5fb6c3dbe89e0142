"""Resolve the names of a config: find the methods, surfaces, scenes and views that they stand for."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError, Surface, Variant, View
from harness.experiment.config import ASKED, BESIDE_INCLUDE, DRAWN, Config, Experiment, MethodChoice, SurfaceChoice
from harness.experiment.toml_file import ConfigFile, Where, gathered
from harness.limits import Distinct, Known
from harness.plugins import Catalog
from harness.scenes.choice import cut, scenes_of
from harness.scenes.model import Scene
from harness.scenes.views import by_angle, by_direction


def resolve(config: Config, file: ConfigFile, catalog: Catalog) -> Experiment:
    """Resolve every name that a config holds. Raises FirsthitError with file and line for each that is not there."""
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
    for i, included in enumerate(paths):
        if not included.is_file():
            raise file.error(("include", i), f"include: there is no config {included}")
    return Experiment(file.path.stem, file.path, file.text, config, (), (), (), (), tuple(paths))


def _with_all_views(config: Config, file: ConfigFile) -> Config:
    """Add the views of `angles` and `directions`. Raises FirsthitError where two views have one name."""
    views = [*config.view]
    views += by_angle(config.angles) if config.angles else []
    views += by_direction(config.directions) if config.directions else []
    if problem := Distinct().broken([view.name for view in views]):
        raise file.error(("view",), f"view: {problem}")
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
        try:
            return _variants_of(one[1], catalog, file.path.parent)
        except FirsthitError as error:
            raise file.error(("method", one[0], "name"), str(error), error.exit_code) from None

    chosen = gathered(enumerate(config.method), of)
    variants = [variant for own in chosen for variant in own]
    bound = [(variant.method, variant.parameters) for variant in variants]
    if twice := [variant for variant, key in zip(variants, bound, strict=True) if bound.count(key) > 1]:
        raise file.error(("method",), f"{twice[0]} is named twice")
    return variants, {v: choice for choice, own in zip(config.method, chosen, strict=True) for v in own}


def _variants_of(choice: MethodChoice, catalog: Catalog, beside: Path) -> list[Variant]:
    """Bind one method's knobs: its settings, its deviations, and every combination of the values given.

    Raises FirsthitError for a method, setting or knob that there is not; a folder in `beside` may be the method's.
    """
    plugin = catalog.get(choice.name, beside)
    variants = [plugin.setting(name) for name in choice.settings]
    variants += plugin.deviations() if choice.deviations else []
    if choice.parameters or not variants:
        variants += [plugin.variant(point) for point in _grid(choice.parameters)]
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
        problem = Known(lambda: known).broken([given])
        if name in file.table and problem:
            raise file.error((name,), f"{name}: {problem}")


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
