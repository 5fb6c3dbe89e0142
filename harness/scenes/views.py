"""Make sets of views, which a config names in a line or two. Reports show by set how a method depends on the view."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, field
from typing import Annotated

from harness.contract import FirsthitError, View
from harness.limits import AZIMUTH, DISTANCE, ELEVATION, FIELD_OF_VIEW, SEED, Within

ANGLES, DIRECTIONS, PATH = "angles", "directions", "path"  # the sets' names, which rows carry
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


@dataclass(frozen=True)
class PathChoice:
    """State the path of a camera that moves about its target; each frame is a view.

    Frame i of n, from 0, is at the share i / n of the path. So a full turn shows nothing twice.

    frames: how many
    azimuth, elevation: of the first frame, as for a View
    turn: degrees of azimuth from the path's start to its end; 360 is an orbit
    rise: degrees of elevation from the path's start to its end
    fov, distance: as for a View, and the same for all frames
    """

    frames: Annotated[int, Within(2, 10_000)] = 60
    azimuth: Annotated[float, AZIMUTH] = 30.0
    elevation: Annotated[float, ELEVATION] = 30.0
    turn: Annotated[float, AZIMUTH] = 360.0
    rise: Annotated[float, Within(-180.0, 180.0)] = 0.0
    fov: Annotated[float, FIELD_OF_VIEW] = 30.0
    distance: Annotated[float, DISTANCE] | None = None


def along_path(choice: PathChoice) -> list[View]:
    """Return the view of each frame of a path, in their order; angles are rounded to 1/10,000 of a degree.

    Raises FirsthitError where the path stands still, or leaves the elevations that there are.
    """
    if not (choice.turn or choice.rise):
        raise FirsthitError("turn and rise are both 0, so that the camera stands still")
    views = []
    for i in range(choice.frames):
        share = i / choice.frames
        azimuth, elevation = choice.azimuth + share * choice.turn, choice.elevation + share * choice.rise
        if abs(elevation) > 90.0:
            raise FirsthitError(f"the camera rises to an elevation of {elevation:g} degrees; it can from -90 to 90")
        name = f"frame {i + 1:0{len(str(choice.frames))}}"
        placed = round(azimuth - 360.0 * round(azimuth / 360.0), 4), round(elevation, 4)
        views.append(View(name, *placed, choice.fov, choice.distance, set=PATH))
    return views


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
