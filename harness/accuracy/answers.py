"""What a kernel answered, held to what an answer can be: once, where it is read back and the surface is known.

A hit is a finite t inside the interval that its ray spends in the domain, from t_min on. The kernel knows that interval
to float32 only: it widens the domain by a few roundings, so that a surface that touches the wall is not cut off, and
rounds t. So the domain is taken SLACK of its size (radius, and distance of its centre from the origin) wider here, and
t may be off by as much; where rays are clipped at the eye, also by SLACK_OF_T of its distance. A hit elsewhere, a
status that is none and a count of evaluations outside 0 … MOST_EVALUATIONS (the kernels' packing tells those two) is
INVALID: a wrong answer of its own kind, whatever the truth. So is a hit of no evaluation. A ray that passes the domain
by spends none, and beams share theirs among pixels, so that 0 is a count.
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
    """The answers for rays float32[n, 6], with those that cannot be answers marked INVALID and their t NaN.

    A ray that `counts` evaluations of its own has spent one where it hits; behind a prepass, which shares its own among
    a tile's rays, it need not. `origin` is where the program's t began.
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
    """bool[n]: whether t is inside the interval that its ray float32[n, 6] spends in the domain from t_min on."""
    if origin == "nearest":
        return _within(domain, rays, t, t_min, SLACK * _size(domain))
    away = np.linalg.norm(rays[:, :3].astype(np.float64) - domain.center, axis=1)
    doubled = np.exp2(np.ceil(np.log2(np.maximum(away, domain.radius))))  # so that few distances stand for all
    possible = np.zeros(len(rays), np.bool_)
    for distance in np.unique(doubled):
        mine = doubled == distance
        off = SLACK * _size(domain) + SLACK_OF_T * float(distance)
        possible[mine] = _within(domain, rays[mine], t[mine], t_min, off)
    return possible


def _within(
    domain: Domain, rays: NDArray[np.float32], t: NDArray[np.float64], t_min: float, off: float
) -> NDArray[np.bool_]:
    """bool[n]: as `reachable`, where the domain's ends and t may be `off`, scene units."""
    reach = clip_many(_widened(domain, off), rays.astype(np.float64))
    lower, upper = np.maximum(reach.enter_lower, t_min) - off, reach.leave_upper + off
    return np.asarray(~reach.missed & (lower <= t) & (t <= upper))


def validated_beams(hits: Hits, domain: Domain, rays: NDArray[np.float32], forward: NDArray[np.float32]) -> Hits:
    """Do what `validated` does, for beams brought to the rays that they hold.

    Depths are along `forward`, float32[3].
    A beam's hit is the middle of a piece in depth of a whole pixel: it is held against the depths of the domain's
    bounding sphere.
    """
    ahead = forward.astype(np.float64)
    wide = rays.astype(np.float64)
    middle = (np.asarray(domain.center) - wide[:, :3]) @ ahead
    reach = domain.radius + SLACK * (_size(domain) + np.abs(middle))
    depth = hits.t * (wide[:, 3:] @ ahead)
    return only(hits, (np.maximum(middle - reach, 0.0) <= depth) & (depth <= middle + reach))


def only(hits: Hits, possible: NDArray[np.bool_]) -> Hits:
    """The answers with each hit that is not finite, or not `possible` (bool[n]), made an INVALID one."""
    right = np.isfinite(hits.t) & possible
    known = np.isin(hits.status, (RayStatus.MISS, RayStatus.EXHAUSTED)) | ((hits.status == RayStatus.HIT) & right)
    known &= hits.evaluations >= 0
    status = np.where(known, hits.status, np.uint8(RayStatus.INVALID)).astype(np.uint8)
    return dataclasses.replace(hits, t=np.where(status == RayStatus.HIT, hits.t, np.nan), status=status)


def invalid(hits: Hits) -> int:
    """How many answers are none."""
    return int((hits.status == RayStatus.INVALID).sum())


def _size(domain: Domain) -> float:
    return float(domain.radius + np.linalg.norm(domain.center))


def _widened(domain: Domain, by: float) -> Domain:
    if isinstance(domain, Box):
        low, high = (np.asarray(corner) for corner in (domain.lower, domain.upper))
        return Box(tuple(low - by), tuple(high + by))
    return Sphere(domain.radius + by, domain.center)
