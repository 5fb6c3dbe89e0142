"""Make scenes of what a config states in its tables [scene.NAME]."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Annotated

import numpy as np

from harness.contract import FirsthitError, Point, Surface, Variant, View
from harness.limits import AZIMUTH, DISTANCE, ELEVATION, FIELD_OF_VIEW, SEED, SHARE, Distinct, Line, Name, Named, Within
from harness.scenes.generate import COUNT, GENERATORS, generate
from harness.scenes.model import COLOUR, Floats, Group, Scene

Angle = Annotated[float, Within(-360.0, 360.0)]  # degrees
Intensity = Annotated[float, SHARE]  # of a colour


def _generators() -> Iterable[str]:
    """List the ways to generate a scene; Annotated types call this by its name."""
    return GENERATORS


@dataclass(frozen=True)
class PlacedChoice:
    """State one instance of a config: world = at + scale · turn · local.

    surface: a name of the catalog, or of a surface of the config's own
    parameters: of the surface, by name
    domain: cuts out a part: a quarter torus is a torus in a box that begins at 0
    at: where the surface's origin is put, scene units
    turn: degrees about x, then y, then z
    scale: by what lengths are multiplied
    colour: red, green and blue, from 0 to 1
    method: draws this instance, whatever methods the experiment compares; `polygon` and `contour` make it a mesh
    knobs: values of that method's knobs, by name
    """

    surface: Annotated[str, Name()]
    parameters: Annotated[dict[str, float | Annotated[str, Line()]], Name()] = field(default_factory=dict)
    domain: Annotated[str, Line()] = ""
    at: Point = (0.0, 0.0, 0.0)
    turn: tuple[Angle, Angle, Angle] = (0.0, 0.0, 0.0)
    scale: Annotated[float, Within(1e-9, 1e9, "a scale is positive, from {low:g} to {high:g}, not {value:g}")] = 1.0
    colour: tuple[Intensity, Intensity, Intensity] = COLOUR
    method: Annotated[str, Name(or_none=True)] = ""
    knobs: Annotated[dict[str, float], Name()] = field(default_factory=dict)


@dataclass(frozen=True)
class SceneChoice:
    """State a scene of a config: instances, and one view.

    title: what reports call it, if that is not its name
    placed: instances, one by one
    generate: makes the instances instead: a lattice, scattered ones, pipes or a molecule
    counts: how many are made; each makes a scene
    seed: of what is made at random
    azimuth, elevation: direction from the scene's middle to the eye, degrees
    fov: the full vertical angle of view, degrees
    distance: from the eye to the scene's middle, scene units; if none is given, all instances fit the field of view
    """

    title: Annotated[str, Line()] = ""
    placed: list[PlacedChoice] = field(default_factory=list)
    generate: Annotated[str, Named(_generators)] = ""
    counts: Annotated[list[Annotated[int, COUNT]], Distinct()] = field(default_factory=lambda: [100])
    seed: Annotated[int, SEED] = 1
    azimuth: Annotated[float, AZIMUTH] = 30.0
    elevation: Annotated[float, ELEVATION] = 30.0
    fov: Annotated[float, FIELD_OF_VIEW] = 30.0
    distance: Annotated[float, DISTANCE] | None = None


def scenes_of(
    name: str,
    choice: SceneChoice,
    surface_of: Callable[[PlacedChoice], Surface],
    variant_of: Callable[[PlacedChoice], Variant],
) -> list[Scene]:
    """Return the scenes that a table describes.

    `surface_of` and `variant_of` look up the surface and the variant of an instance. Raises FirsthitError if the table
    has neither instances nor a generator, or both.
    """
    view = View(name, choice.azimuth, choice.elevation, choice.fov, choice.distance)
    if bool(choice.placed) == bool(choice.generate):
        raise FirsthitError(f"scene {name!r} needs instances in `placed`, or a way to `generate` them, and not both")
    if choice.generate:
        return [generate(choice.generate, count, choice.seed, view) for count in choice.counts]
    groups = []
    for one in choice.placed:
        groups.append(
            Group(
                (surface_of(one),),
                np.array([one.at]),
                rotation(*one.turn)[None],
                np.array([one.scale]),
                np.array([one.colour]),
                variant_of(one) if one.method else None,
            )
        )
    return [Scene(name, choice.title or name, tuple(groups), view, name)]


def rotation(x: float, y: float, z: float) -> Floats:
    """Return the rotation float64[3, 3] by x, y and z degrees about the x axis, then the y axis, then the z axis."""
    made = np.eye(3)
    for axis, degrees in enumerate((x, y, z)):
        angle, (i, j) = math.radians(degrees), [(1, 2), (2, 0), (0, 1)][axis]
        turn = np.eye(3)
        turn[i, i] = turn[j, j] = math.cos(angle)
        turn[i, j], turn[j, i] = -math.sin(angle), math.sin(angle)
        made = turn @ made
    return made


def cut(surface: Surface, domain: str) -> Surface:
    """Return the surface in another domain, or as it is if `domain` is empty.

    Its bounding radius is dropped, since it is about the old domain's centre. So is f as its own distance where that
    does not hold in the new domain. Raises FirsthitError for a domain that cannot be read.
    """
    import surfaces

    if not domain:
        return surface
    other = surfaces.from_formula(surface.formula, domain, parameters=dict(surface.parameters))
    distance = other.distance if surface.distance == surface.formula else surface.distance
    return dataclasses.replace(surface, domain=other.domain, bounding_radius=None, facts=(), distance=distance)
