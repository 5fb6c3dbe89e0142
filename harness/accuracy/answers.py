"""Mark the impossible answers of a kernel, where they are read back and the surface is known.

A hit must have a finite t inside the interval that its ray spends in the domain, from t_min on. The kernel knows that
interval to float32 only. It widens the domain by a few roundings, so that a surface that touches the domain's boundary
is not cut off, and it rounds t. So the domain is taken wider here by SLACK of its size (radius, and distance of its
centre from the origin), and t may be off by as much; if rays are clipped at the eye, also by SLACK_OF_T of the eye's
distance.

These answers are INVALID: a hit elsewhere, a status that does not exist, a count of evaluations outside 0 …
MOST_EVALUATIONS (the kernels' packing tells these two), and a hit without an evaluation. INVALID is a wrong answer of
its own kind, whatever the truth. A count of 0 is allowed otherwise: a ray that passes the domain by spends none, and
beams share theirs among pixels.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Domain, Hits, Origin, RayStatus, Sphere
from harness.oracle.clip import clip_many

SLACK = 2.0**-17  # of the domain's size: 128 roundings in float32, of which the clip spends 16
SLACK_OF_T = 2.0**-20  # 16 roundings in float32


def validated(
    hits: Hits,
    domain: Domain,
    rays: NDArray[np.float32],
    t_min: float = 0.0,
    counts: bool = True,
    origin: Origin = "nearest",
) -> Hits:
    """Return the answers for rays float32[n, 6], with impossible answers marked INVALID, and their t NaN.

    With `counts` a ray that hits must have spent an evaluation of its own. Rays behind a prepass need not, since the
    prepass shares its evaluations among the rays of a tile. `origin` is where the program's t began.
    """
    possible = reachable(domain, rays, hits.t, t_min, origin)
    return only(hits, possible & (hits.evaluations > 0) if counts else possible)


def reachable(
    domain: Domain,
    rays: NDArray[np.float32],
    t: NDArray[np.float64],
    t_min: float = 0.0,
    origin: Origin = "nearest",
) -> NDArray[np.bool_]:
    """Return bool[n]: t is inside the interval that its ray float32[n, 6] spends in the domain from t_min on."""
    if origin == "nearest":
        return _within(domain, rays, t, t_min, SLACK * _size(domain))
    away = np.linalg.norm(rays[:, :3].astype(np.float64) - domain.center, axis=1)
    doubled = np.exp2(np.ceil(np.log2(np.maximum(away, domain.radius))))  # up to a power of 2, so that few differ
    possible = np.zeros(len(rays), np.bool_)
    for distance in np.unique(doubled):
        mine = doubled == distance
        off = SLACK * _size(domain) + SLACK_OF_T * float(distance)
        possible[mine] = _within(domain, rays[mine], t[mine], t_min, off)
    return possible


def _within(
    domain: Domain, rays: NDArray[np.float32], t: NDArray[np.float64], t_min: float, off: float
) -> NDArray[np.bool_]:
    """Return bool[n] as `reachable` does, where the domain's ends and t may be off by `off`, in scene units."""
    reach = clip_many(_widened(domain, off), rays.astype(np.float64))
    lower, upper = np.maximum(reach.enter_lower, t_min) - off, reach.leave_upper + off
    return np.asarray(~reach.missed & (lower <= t) & (t <= upper))


def validated_beams(hits: Hits, domain: Domain, rays: NDArray[np.float32], forward: NDArray[np.float32]) -> Hits:
    """Do what `validated` does for beams that were brought to the rays that they hold.

    A beam's hit is the middle of a piece in depth of a whole pixel. So its depth, along `forward` float32[3], is held
    against the depths of the domain's bounding sphere.
    """
    ahead = forward.astype(np.float64)
    wide = rays.astype(np.float64)
    middle = (np.asarray(domain.center) - wide[:, :3]) @ ahead
    reach = domain.radius + SLACK * (_size(domain) + np.abs(middle))
    depth = hits.t * (wide[:, 3:] @ ahead)
    return only(hits, (np.maximum(middle - reach, 0.0) <= depth) & (depth <= middle + reach))


def only(hits: Hits, possible: NDArray[np.bool_]) -> Hits:
    """Return the answers with each hit INVALID whose t is not finite, or that is not `possible`, bool[n]."""
    right = np.isfinite(hits.t) & possible
    known = np.isin(hits.status, (RayStatus.MISS, RayStatus.EXHAUSTED)) | ((hits.status == RayStatus.HIT) & right)
    known &= hits.evaluations >= 0
    status = np.where(known, hits.status, np.uint8(RayStatus.INVALID)).astype(np.uint8)
    return dataclasses.replace(hits, t=np.where(status == RayStatus.HIT, hits.t, np.nan), status=status)


def invalid(hits: Hits) -> int:
    """Count the answers that are INVALID."""
    return int((hits.status == RayStatus.INVALID).sum())


def _size(domain: Domain) -> float:
    return float(domain.radius + np.linalg.norm(domain.center))


def _widened(domain: Domain, by: float) -> Domain:
    if isinstance(domain, Box):
        low, high = (np.asarray(corner) for corner in (domain.lower, domain.upper))
        return Box(tuple(low - by), tuple(high + by))
    return Sphere(domain.radius + by, domain.center)
