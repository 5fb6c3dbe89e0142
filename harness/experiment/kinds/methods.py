"""Which kind a method is of, by what its kernel casts."""

from __future__ import annotations

from harness.contract import Casts, Method
from harness.experiment.kinds.beams import BeamMethods
from harness.experiment.kinds.mesh import MeshMethods
from harness.experiment.kinds.model import MethodKind
from harness.experiment.kinds.rays import RayMethods

METHOD_KINDS: dict[Casts, MethodKind] = {
    "rays": RayMethods(),
    "beams": BeamMethods(quadtree=False),
    "quadtree": BeamMethods(quadtree=True),
    "mesh": MeshMethods(),
}


def of_method(method: Method) -> MethodKind:
    """Return the kind of a method."""
    return METHOD_KINDS[method.casts]
