"""Make what a device reads of instances: records of 32 numbers, and the depth buffer's map."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, FirsthitError, Surface
from harness.devices.raster import RECORD
from harness.scenes.model import Group, Scene, bounding_radius
from surfaces.formula import number

Floats = NDArray[np.float64]
MOST_PARAMETERS = 4  # how many parameters a formula may have whose instances differ in them
CLOSEST = 1e-4  # of the far plane's distance: the near plane is no closer to the eye


def pack(group: Group) -> NDArray[np.float32]:
    """Return the instances as glsl/raster/instance.glsl reads them, float32[n, RECORD]."""
    n = len(group)
    records = np.zeros((n, RECORD), np.float64)
    inverse = group.turn.transpose(0, 2, 1) / group.scale[:, None, None]
    offset = -np.einsum("nij,nj->ni", inverse, group.place)
    for row in range(3):
        records[:, 4 * row : 4 * row + 3] = inverse[:, row]
        records[:, 4 * row + 3] = offset[:, row]
    own = {surface: _own(surface, group.varies) for surface in group.distinct}
    records[:, 12:] = [own[surface] for surface in group.surfaces] if group.varies else own[group.distinct[0]]
    records[:, 15] = group.scale
    records[:, 24:27] = group.colours
    return records.astype(np.float32)


def _own(surface: Surface, varies: bool) -> list[float]:
    """Return numbers 12 to 31 of the records of a surface's instances.

    `varies` says whether the instances of its group differ in their parameters, which are then part of the record.
    Numbers 15 and 24 to 26 are placeholders: `pack` writes each instance's own scale and colour there.
    """
    domain, radius = surface.domain, bounding_radius(surface)
    lower, upper = _box_of(surface, tight=not varies)
    parameters = [number(value) for _, value in sorted(surface.parameters)][:MOST_PARAMETERS] if varies else []
    feature = surface.feature_radius or domain.radius
    stretch = (1.0, 1.0, 1.0)
    numbers = [*lower, 1.0, *upper, radius, *stretch, domain.radius, 0.0, 0.0, 0.0, feature, *parameters]
    return numbers + [0.0] * (RECORD - 12 - len(numbers))


def _box_of(surface: Surface, tight: bool = True) -> tuple[Floats, Floats]:
    """Return the lower and the upper corner, float64[3] each, of a box that holds all that is seen of the surface.

    It is the box about the domain; if `tight`, cut to the box about the bounding sphere, which may be smaller.
    """
    domain, center = surface.domain, np.array(surface.domain.center)
    if isinstance(domain, Box):
        lower, upper = np.array(domain.lower), np.array(domain.upper)
    else:
        lower, upper = center - domain.radius, center + domain.radius
    if not tight:
        return lower, upper
    radius = bounding_radius(surface)
    return np.maximum(lower, center - radius), np.minimum(upper, center + radius)


def depth_map(scene: Scene, camera: NDArray[np.float32]) -> tuple[float, float]:
    """Return a and b of the depth a + b / s that the depth buffer holds at distance s along the camera's forward axis.

    The depth is 0 at the near plane and 1 at the far plane, which stand close before and behind all instances.
    `camera` is float32[12] as `camera_for` makes it. Raises FirsthitError if the eye is inside an instance's bounding
    sphere, since the front faces of its proxy may then not be seen, and if all instances are behind the eye.
    """
    eye, forward = camera[:3].astype(np.float64), camera[3:6].astype(np.float64)
    spheres = np.concatenate([group.spheres for group in scene.groups])
    away = np.linalg.norm(spheres[:, :3] - eye, axis=1)
    if inside := int((away <= 1.001 * spheres[:, 3]).sum()):
        raise FirsthitError(
            f"the eye is inside the bounding spheres of {inside} instances: the raster stage draws what "
            "is in front of it; raise the view's distance"
        )
    s = (spheres[:, :3] - eye) @ forward
    near, far = 0.999 * float((s - spheres[:, 3]).min()), 1.001 * float((s + spheres[:, 3]).max())
    if far <= 0.0:
        raise FirsthitError("all instances are behind the eye; turn the view or raise its distance")
    near = max(near, CLOSEST * far)
    return far / (far - near), -far * near / (far - near)
