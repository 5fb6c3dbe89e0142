"""Collect the parts of a report. Every module in this folder is one, and no list names them.

A part has ORDER, a whole number that places it, and `sections(material)`, which returns its sections: [] where the run
has nothing for it. In the report of a run that collects others, parts with LEADS come first, because the run collects
the others for them.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterable
from typing import Protocol, cast

from reports.content import Section
from reports.material import Material


class Part(Protocol):
    """Describe a module that makes sections of a report."""

    ORDER: int
    __name__: str

    def sections(self, material: Material, /) -> list[Section]:
        """Make the sections of this part; [] where the run has nothing for it."""


def found(package: str, folders: Iterable[str]) -> list[Part]:
    """Import every module in the `folders` of `package`, and return them in the order of their ORDER."""
    names = (module.name for module in pkgutil.iter_modules(folders))
    parts = [cast(Part, importlib.import_module(f"{package}.{name}")) for name in names]
    return sorted(parts, key=lambda part: (part.ORDER, part.__name__))


def sections(material: Material, tell: Callable[[str], None] = lambda _: None) -> list[Section]:
    """Return the sections of every part, in the order of the parts; `tell` hears of each before it is drawn."""
    parts = found(__name__, __path__)
    if material.run.plan.include:
        parts.sort(key=lambda part: not hasattr(part, "LEADS"))
    made: list[Section] = []
    for number, part in enumerate(parts, 1):
        tell(f"drawing [{number}/{len(parts)}] {part.__name__.rpartition('.')[2].replace('_', ' ')}")
        made += part.sections(material)
    return made
