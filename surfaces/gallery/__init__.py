"""Hold the gallery: surfaces of the literature beside the catalog's, in groups that are hard in different ways.

Each group is a module with TITLE, what its surfaces have in common, and SURFACES, made by surfaces.entries. Equations
are written from the literature, which `source` names; what they state is recomputed by tests/test_gallery_facts.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from surfaces.gallery import (
    blobs,
    classical,
    distances,
    high_degree,
    immersed,
    minimal,
    molecules,
    nodal,
    parts,
    singular_curves,
    singular_points,
)
from surfaces.model import Surface


@dataclass(frozen=True)
class Group:
    """Hold a group's surfaces, and what they have in common."""

    title: str
    surfaces: tuple[Surface, ...]


_MODULES = (
    nodal,
    singular_points,
    singular_curves,
    classical,
    immersed,
    minimal,
    distances,
    blobs,
    molecules,
    parts,
    high_degree,
)
GROUPS: Mapping[str, Group] = {
    name: Group(module.TITLE, tuple(replace(surface, group=name) for surface in module.SURFACES))
    for module in _MODULES
    for name in (module.__name__.rpartition(".")[2],)
}
