"""Offer `firsthit list`: what there is to choose from."""

from __future__ import annotations

import argparse
import sys
import tomllib
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from harness import console, escaping
from harness.commands import Add
from harness.commands.answers import listed
from harness.commands.machine import Answer, add_json
from harness.contract import CLAIMS, DeviceInfo, FirsthitError, Parameter, Surface
from harness.experiment import shipped
from harness.plugins import Catalog, Plugin, find_methods

if TYPE_CHECKING:
    from pathlib import Path


def add_parsers(add: Add) -> None:
    parser = add("list", "firsthit list surfaces")
    parser.add_argument("what", choices=["methods", "surfaces", "configs", "devices"])
    add_json(parser)
    parser.set_defaults(run=_list)


def _list(options: argparse.Namespace) -> int | Answer:
    listing = {"methods": _methods, "surfaces": _surfaces, "configs": _configs, "devices": _device_names}
    facts = {"methods": _method_facts, "surfaces": _surface_facts, "configs": _config_facts, "devices": _device_facts}
    if options.json:
        return Answer(facts[options.what](options))
    print(listing[options.what](options))
    return 0


def _found(options: argparse.Namespace) -> Catalog:
    """Find the methods, and say on standard error what the user should know of how they were found."""
    catalog = find_methods(options.plugins)
    for note in catalog.notes:
        print(f"firsthit: {note}", file=sys.stderr)
    return catalog


def _methods(options: argparse.Namespace) -> str:
    """Write tables of the methods, of what their claims mean, and of their parameters."""
    catalog, rows = _found(options), []
    for name, plugin in sorted(catalog.plugins.items()):
        method = plugin.method
        claims = ", ".join(sorted(method.claims)) if method.answers else "(measures the harness's floor)"
        printed = ", ".join(f"{knob} = {value:g}" for knob, value in method.printed.items()) or "its default"
        printed = "-" if not method.answers or method.source.startswith("firsthit") else printed
        rows.append((name, method.source, printed, ", ".join(method.settings) or "-", claims or "none"))
    knobs = [
        (name, p.name, f"{p.default:g}", {"up": "larger", "down": "smaller", None: "-"}[p.finer], p.meaning)
        for name, plugin in sorted(catalog.plugins.items())
        for p in plugin.method.parameters
    ]
    stated = {claim for plugin in catalog.plugins.values() for claim in plugin.method.claims}
    meanings = [(claim, meaning) for claim, meaning in CLAIMS.items() if claim in stated]
    broken = [escaping.one_line(f"{name}: cannot be loaded: {reason}") for name, reason in catalog.broken.items()]
    tables = (
        console.table(("name", "source", "as printed", "papers' settings", "claims"), rows),
        console.table(("claim", "meaning"), meanings),
        console.table(("method", "parameter", "default", "finer", "meaning"), knobs),
    )
    return "\n\n".join([*tables, *broken])


def _method_facts(options: argparse.Namespace) -> listed.ListedMethods:
    catalog, chosen = _found(options), [surface for own in _every_surface().values() for surface in own]
    methods = [_method(plugin, chosen) for _, plugin in sorted(catalog.plugins.items())]
    stated = {claim for one in methods for claim in one.claims}
    claims = {claim: meaning for claim, meaning in CLAIMS.items() if claim in stated}
    return listed.ListedMethods(methods, claims, dict(sorted(catalog.broken.items())))


def _method(plugin: Plugin, chosen: Sequence[Surface]) -> listed.MethodFacts:
    method = plugin.method
    refused = {surface.name: _refusal(method.accepts, surface) for surface in chosen}
    return listed.MethodFacts(
        name=method.name,
        source=method.source,
        folder=str(plugin.folder),
        casts=method.casts,
        rest=method.rest,
        answers=method.answers,
        precisions=method.precisions,
        knobs=[_knob(knob) for knob in method.parameters],
        settings=method.settings,
        claims=sorted(method.claims),
        needs=method.needs,
        libraries=method.libraries,
        refuses={name: reason for name, reason in refused.items() if reason is not None},
    )


def _refusal(accepts: Callable[[Surface], str | None], surface: Surface) -> str | None:
    """Say why a method cannot be used on a surface; None where it can. A method that goes wrong there cannot."""
    try:
        return accepts(surface)
    except FirsthitError as error:
        return str(error)


def _knob(knob: Parameter) -> listed.KnobFacts:
    whole = isinstance(knob.default, int)
    words = (knob.meaning, knob.finer, knob.sweep, knob.per, knob.printed)
    return listed.KnobFacts(knob.name, whole, knob.default, *words)


def _with_forms(group: str) -> list[Surface]:
    """Return each surface of a group, followed by its other forms."""
    import surfaces

    return [surfaces.get(form) for name in surfaces.names(group) for form in (name, *surfaces.forms_of(name))]


def _every_surface() -> dict[str, list[Surface]]:
    """Return the surfaces of each group, each followed by its other forms."""
    import surfaces

    return {group: _with_forms(group) for group in surfaces.groups()}


def _surfaces(_options: argparse.Namespace) -> str:
    import surfaces

    header, tables = ("name", "degree", "operations", "title", "source"), []
    for group, title in surfaces.groups().items():
        rows = [
            (s.name, "-" if s.degree is None else s.degree, sum(surfaces.operations(s).values()), s.title, s.source)
            for s in _with_forms(group)
        ]
        tables.append(f"{group}: {title}\n\n{console.table(header, rows)}")
    return "\n\n".join(tables)


def _surface_facts(_options: argparse.Namespace) -> listed.ListedSurfaces:
    import surfaces

    told = [_surface(surface, group) for group, own in _every_surface().items() for surface in own]
    return listed.ListedSurfaces(told, surfaces.groups())


def _surface(surface: Surface, group: str) -> listed.SurfaceFacts:
    import surfaces

    return listed.SurfaceFacts(
        name=surface.name,
        group=group,
        form_of=None if surface.base == surface.name else surface.base,
        title=surface.title,
        source=surface.source,
        formula=surface.formula,
        degree=surface.degree,
        domain=listed.domain_facts(surface.domain),
        parameters=dict(surface.parameters),
        operations=surfaces.operations(surface),
        distance=surface.distance,
        bounding_radius=surface.bounding_radius,
        feature_radius=surface.feature_radius,
        facts=dict(surface.facts),
    )


def _titles() -> list[tuple[Path, str]]:
    """Return file and title of each config that firsthit ships."""
    paths = [shipped.located(name) for name in shipped.names()]
    return [(path, tomllib.loads(path.read_text(encoding="utf-8"))["title"]) for path in paths]


def _configs(_options: argparse.Namespace) -> str:
    return console.table(("config", "title"), [(path.stem, title) for path, title in _titles()])


def _config_facts(_options: argparse.Namespace) -> listed.ListedConfigs:
    return listed.ListedConfigs([listed.ConfigFacts(path.stem, title, str(path)) for path, title in _titles()])


def _devices() -> list[DeviceInfo]:
    from harness.devices.discovery import known_devices

    return known_devices().devices


def _device_names(_options: argparse.Namespace) -> str:
    rows = [(info.name, info.title, info.problem or "usable") for info in _devices()]
    return console.table(("name", "title", "state"), rows)


def _device_facts(_options: argparse.Namespace) -> listed.ListedDevices:
    return listed.ListedDevices([listed.device(info) for info in _devices()])
