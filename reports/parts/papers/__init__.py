"""The papers' tables and figures, ours beside theirs. A module here has ORDER and `sections(material)`; no list names
them. Each section ends with the verdicts on the claims that its config's rows decide."""

from __future__ import annotations

import importlib
import pkgutil
from typing import Any

from reports.content import Section
from reports.material import Material

ORDER = 65
LEADS = True


def sections(material: Material) -> list[Section]:
    modules: list[Any] = [
        importlib.import_module(f"{__name__}.{found.name}") for found in pkgutil.iter_modules(__path__)
    ]
    shown = sorted((module for module in modules if hasattr(module, "ORDER")), key=lambda module: module.ORDER)
    return [section for module in shown for section in module.sections(material)]
