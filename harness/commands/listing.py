"""Offer `firsthit list`: what there is to choose from."""

from __future__ import annotations

import argparse
import sys
import tomllib

from harness import console
from harness.commands import Add
from harness.contract import CLAIMS
from harness.experiment import shipped
from harness.plugins import find_methods


def add_parsers(add: Add) -> None:
    parser = add("list", "firsthit list surfaces")
    parser.add_argument("what", choices=["methods", "surfaces", "configs", "devices"])
    parser.set_defaults(run=_list)


def _list(options: argparse.Namespace) -> int:
    listing = {"methods": _methods, "surfaces": _surfaces, "configs": _configs, "devices": _device_names}
    print(listing[options.what](options))
    return 0


def _methods(options: argparse.Namespace) -> str:
    """Write tables of the methods, of what their claims mean, and of their parameters."""
    catalog = find_methods(options.plugins)
    for note in catalog.notes:
        print(f"firsthit: {note}", file=sys.stderr)
    rows = []
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
    broken = [f"{name}: cannot be loaded: {reason}" for name, reason in catalog.broken.items()]
    tables = (
        console.table(("name", "source", "as printed", "papers' settings", "claims"), rows),
        console.table(("claim", "meaning"), meanings),
        console.table(("method", "parameter", "default", "finer", "meaning"), knobs),
    )
    return "\n\n".join([*tables, *broken])


def _surfaces(_options: argparse.Namespace) -> str:
    import surfaces

    header = ("name", "degree", "operations", "title", "source")
    listed = []
    for group, title in surfaces.groups().items():
        chosen = [surfaces.get(form) for name in surfaces.names(group) for form in (name, *surfaces.forms_of(name))]
        rows = [
            (s.name, "-" if s.degree is None else s.degree, sum(surfaces.operations(s).values()), s.title, s.source)
            for s in chosen
        ]
        listed.append(f"{group}: {title}\n\n{console.table(header, rows)}")
    return "\n\n".join(listed)


def _configs(_options: argparse.Namespace) -> str:
    paths = [shipped.located(name) for name in shipped.names()]
    rows = [(path.stem, tomllib.loads(path.read_text(encoding="utf-8"))["title"]) for path in paths]
    return console.table(("config", "title"), rows)


def _device_names(_options: argparse.Namespace) -> str:
    from harness.devices.discovery import known_devices

    rows = [(info.name, info.title, info.problem or "usable") for info in known_devices().devices]
    return console.table(("name", "title", "state"), rows)
