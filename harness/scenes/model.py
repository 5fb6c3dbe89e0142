"""Define scenes and their groups of instances. Instances that share a formula form a group, which one call draws."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Sphere, Surface, Variant, View, digest, plural

Floats = NDArray[np.float64]
COLOUR = (0.36, 0.58, 0.82)


@dataclass(frozen=True, eq=False)
class Group:
    """Hold n instances of one formula: world = place + scale · turn · local.

    `surfaces` holds one surface for all instances, or one for each; these differ in parameters and domain alone. Raises
    FirsthitError if the shapes do not agree, the formulas differ, or a scale is not positive.
    """

    surfaces: tuple[Surface, ...]
    place: Floats  # [n, 3], world units
    turn: Floats  # [n, 3, 3], rotations, world from local
    scale: Floats  # [n]
    colours: Floats  # [n, 3], in [0, 1]
    variant: Variant | None = None  # what draws it; None: the variants that the experiment compares

    def __post_init__(self) -> None:
        n = len(self.place)
        if len(self.surfaces) not in (1, n) or not n:
            raise FirsthitError(
                f"a group of {plural(n, 'instance')} cannot have {plural(len(self.surfaces), 'surface')}"
            )
        if len({surface.formula for surface in self.surfaces}) > 1:
            raise FirsthitError("the instances of a group share one formula")
        shapes = (self.turn.shape, self.scale.shape, self.colours.shape)
        if shapes != ((n, 3, 3), (n,), (n, 3)) or not (self.scale > 0.0).all():
            raise FirsthitError(f"a group of {plural(n, 'instance')} needs as many turns, positive scales and colours")

    def __len__(self) -> int:
        return len(self.place)

    @cached_property
    def distinct(self) -> tuple[Surface, ...]:
        """Return the group's surfaces, each once."""
        return tuple(dict.fromkeys(self.surfaces))

    @property
    def varies(self) -> bool:
        """Return whether the instances differ in parameters or domain."""
        return len(self.distinct) > 1

    @property
    def differ_in(self) -> str:
        """Return the names of the parameters that instances differ in, as text."""
        bound = [dict(surface.parameters) for surface in self.distinct]
        names = [name for name in bound[0] if len({parameters[name] for parameters in bound}) > 1]
        return ", ".join(names) or "their domains"

    @cached_property
    def spheres(self) -> Floats:
        """Return centre and radius of each instance's bounding sphere, in world units: float64[n, 4]."""
        centers = np.array([surface.domain.center for surface in self.surfaces])
        radii = np.array([bounding_radius(surface) for surface in self.surfaces])
        world = self.place + self.scale[:, None] * np.einsum(
            "nij,nj->ni", self.turn, np.broadcast_to(centers, (len(self), 3))
        )
        return np.column_stack([world, self.scale * radii])

    @property
    def identity(self) -> dict[str, object]:
        """Return what decides a picture of the group, for cache keys."""
        arrays = [np.ascontiguousarray(a).tobytes().hex() for a in (self.place, self.turn, self.scale, self.colours)]
        own = [surface.identity for surface in self.surfaces]
        variant = None if self.variant is None else [self.variant.method, dict(self.variant.parameters)]
        return {"surfaces": digest(own), "places": digest(arrays), "variant": variant}


@dataclass(frozen=True, eq=False)
class Scene:
    """Hold groups of instances, as `view` sees them."""

    name: str
    title: str
    groups: tuple[Group, ...]
    view: View
    family: str  # the same for scenes that differ in their count alone

    @property
    def instances(self) -> int:
        """Count the instances of all groups."""
        return sum(map(len, self.groups))

    @cached_property
    def sphere(self) -> Floats:
        """Return centre and radius of a sphere about all instances, in world units: float64[4]."""
        spheres = np.concatenate([group.spheres for group in self.groups])
        lower = (spheres[:, :3] - spheres[:, 3:]).min(axis=0)
        upper = (spheres[:, :3] + spheres[:, 3:]).max(axis=0)
        center = 0.5 * (lower + upper)
        radius = (np.linalg.norm(spheres[:, :3] - center, axis=1) + spheres[:, 3]).max()
        return np.array([*center, radius])

    @property
    def identity(self) -> dict[str, object]:
        """Return what decides a picture of the scene, for cache keys."""
        return {"groups": [group.identity for group in self.groups]}

    @cached_property
    def stand_in(self) -> Surface:
        """Return a surface with the scene's name and size and the first group's formula.

        Rows, cameras and errors, which speak of one surface, take it for the scene's.
        """
        first, (x, y, z, radius) = self.groups[0].distinct[0], self.sphere
        degrees = [surface.degree for group in self.groups for surface in group.distinct]
        features = [
            float((s.feature_radius or s.domain.radius) * group.scale.min())
            for group in self.groups
            for s in group.distinct
        ]
        return Surface(
            name=self.name,
            title=self.title,
            formula=first.formula,
            domain=Sphere(radius, (x, y, z)),
            source="a scene",
            degree=None if None in degrees else max(degree for degree in degrees if degree is not None),
            parameters=first.parameters,
            distance=first.distance,
            feature_radius=min(features),
        )


def bounding_radius(surface: Surface) -> float:
    """Return the radius, in the surface's units, of a sphere about the domain's centre that holds all that is seen."""
    return min(surface.bounding_radius or surface.domain.radius, surface.domain.radius)


def single(surface: Surface, view: View) -> Scene:
    """Return the scene of one surface in its own coordinates, which is what all stages but raster draw."""
    group = Group((surface,), np.zeros((1, 3)), np.eye(3)[None], np.ones(1), np.array([COLOUR]))
    return Scene(surface.name, surface.title, (group,), view, surface.name)
