"""List all ways to cast: the words of `Method.casts`, each with its kind of method and its kind of cell.

A new way to cast is a line here.
"""

from __future__ import annotations

from dataclasses import dataclass

from harness.contract import Casts, Method
from harness.experiment.kinds.beams import BeamMethods, Beams
from harness.experiment.kinds.mesh import Mesh, MeshMethods
from harness.experiment.kinds.methods import MethodKind
from harness.experiment.kinds.model import Kind
from harness.experiment.kinds.rays import RayMethods, Rays
from harness.experiment.kinds.tiles import TileMethods, Tiles


@dataclass(frozen=True)
class Way:
    """State one way to cast: the kind of its methods, and the kind of their cells in stages compute and rays."""

    methods: MethodKind
    cells: Kind


WAYS: dict[Casts, Way] = {
    "rays": Way(RayMethods(), Rays()),
    "beams": Way(BeamMethods(quadtree=False), Beams(quadtree=False)),
    "quadtree": Way(BeamMethods(quadtree=True), Beams(quadtree=True)),
    "tiles": Way(TileMethods(), Tiles()),
    "mesh": Way(MeshMethods(), Mesh()),
}


def of_method(method: Method) -> MethodKind:
    """Return the kind of a method."""
    return WAYS[method.casts].methods
