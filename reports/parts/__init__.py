"""The parts of a report. A module here is a part: `ORDER`, a whole number that places it, and
`sections(material: Material) -> list[Section]`, empty where the run has nothing for it. No list names them.

In the report of a run that collects others, parts with `LEADS` come first: what the collection is about."""

from __future__ import annotations

import importlib
import pkgutil
from typing import Any

from reports.content import Section
from reports.material import Material


def sections(material: Material) -> list[Section]:
    """The sections of every part, in order."""
    modules: list[Any] = [
        importlib.import_module(f"{__name__}.{found.name}") for found in pkgutil.iter_modules(__path__)
    ]
    leads = bool(material.run.plan.include)
    ordered = sorted(modules, key=lambda m: (not (leads and hasattr(m, "LEADS")), m.ORDER, m.__name__))
    return [section for module in ordered for section in module.sections(material)]
