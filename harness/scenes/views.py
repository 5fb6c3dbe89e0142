"""Make sets of views, which a config names in a line or two. Reports show by set how a method depends on the view."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, field
from typing import Annotated

from harness.contract import View
from harness.limits import AZIMUTH, DISTANCE, FIELD_OF_VIEW, SEED, Within

ANGLES, DIRECTIONS = "angles", "directions"  # the sets' names, which rows carry
GOLDEN_TURN = 180.0 * (3.0 - math.sqrt(5.0))  # degrees between neighbours of a Fibonacci lattice


@dataclass(frozen=True)
class AngleChoice:
    """State projection angles as in toledo2007, Table 1: 0° looks down the z axis, 90° looks from the side.

    From azimuth 0 the torus's box covers as many pixels as the paper prints. From other azimuths the box is seen
    turned, and covers more.

    values: degrees; a view's elevation is 90° minus its angle
    azimuth, fov, distance: as for a View, and the same for all angles
    """

    values: list[Annotated[float, Within(0.0, 180.0)]] = field(
        default_factory=lambda: [0.0, 18.0, 36.0, 54.0, 72.0, 90.0]
    )
    azimuth: Annotated[float, AZIMUTH] = 0.0
    fov: Annotated[float, FIELD_OF_VIEW] = 30.0
    distance: Annotated[float, DISTANCE] | None = None


@dataclass(frozen=True)
class DirectionChoice:
    """State directions that are spread evenly over the sphere.

    count: how many
    seed: decides one random rotation of all of them
    fov, distance: as for a View, and the same for all directions
    """

    count: Annotated[int, Within(1, 10_000)] = 24
    seed: Annotated[int, SEED] = 1
    fov: Annotated[float, FIELD_OF_VIEW] = 30.0
    distance: Annotated[float, DISTANCE] | None = None


def by_angle(choice: AngleChoice) -> list[View]:
    """Return a view for each angle, in their order."""
    return [
        View(f"angle {angle:g}", choice.azimuth, 90.0 - angle, choice.fov, choice.distance, set=ANGLES)
        for angle in choice.values
    ]


def by_direction(choice: DirectionChoice) -> list[View]:
    """Return a view from each direction of a turned Fibonacci lattice.

    After Á. González, Measurement of areas on a sphere using Fibonacci and latitude–longitude lattices, 2010. Angles
    are rounded to 1/10,000 of a degree, so that configs can quote them.
    """
    turned = _rotation(choice.seed)
    views = []
    for i in range(choice.count):
        z = 1.0 - (2 * i + 1) / choice.count
        turn, radius = math.radians(i * GOLDEN_TURN), math.sqrt(1.0 - z * z)
        point = (radius * math.cos(turn), radius * math.sin(turn), z)
        x, y, z = (sum(a * b for a, b in zip(row, point, strict=True)) for row in turned)
        azimuth, elevation = math.degrees(math.atan2(y, x)), math.degrees(math.asin(max(-1.0, min(1.0, z))))
        name = f"direction {i + 1:0{len(str(choice.count))}}"
        views.append(View(name, round(azimuth, 4), round(elevation, 4), choice.fov, choice.distance, set=DIRECTIONS))
    return views


def _rotation(seed: int) -> list[tuple[float, float, float]]:
    """Draw a rotation uniformly, by a unit quaternion of four normal deviates, and return its matrix's rows."""
    source = random.Random(f"directions {seed}")
    drawn = [source.gauss(0.0, 1.0) for _ in range(4)]
    length = math.hypot(*drawn)
    w, x, y, z = (part / length for part in drawn)
    return [
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    ]
