"""Compute clip intervals, the parts of rays in a surface's domain: exactly for one ray, enclosed for many."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Domain, Sphere
from harness.oracle import balls64
from harness.oracle.balls64 import TINY, Balls, Floats

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True)
class End:
    """Hold one exact end of a clip interval.

    It is a rational t, or the root (−b + side·√(b² − a·c)) / a of a t² + 2 b t + c.
    """

    value: Any = None  # fmpq, or None
    quadratic: tuple[Any, Any, Any] = (None, None, None)
    side: int = 0

    def ball(self) -> Any:
        """Return the end as a ball (flint.arb) at the current precision."""
        from flint import arb

        if self.value is not None:
            return arb(self.value)
        a, b, c = self.quadratic
        return (self.side * arb(b * b - a * c).sqrt() - b) / a

    def is_root_of(self, p: Any) -> bool:
        """Return whether `p`, a square-free fmpq_poly, vanishes exactly at this end."""
        from flint import fmpq_poly

        if self.value is not None:
            return not p(self.value)
        a, b, c = self.quadratic
        common = p.gcd(fmpq_poly([c, 2 * b, a]))
        if common.degree() != 1:
            return bool(common.degree() == 2)
        root = -common[0] / common[1]
        return bool((a * root + b) * self.side >= 0)


def clip_exactly(domain: Domain, ray: Sequence[Any], t_min: float = 0.0) -> tuple[End, End] | None:
    """Return the closed interval of t >= `t_min` in which a ray, six fmpq, is in the domain, or None."""
    from harness.oracle.reals import rational

    if isinstance(domain, Box):
        lower = [rational(v) for v in domain.lower]
        upper = [rational(v) for v in domain.upper]
        return _clip_by_box(lower, upper, ray, rational(t_min))
    return _clip_by_sphere([rational(v) for v in domain.center], rational(domain.radius), ray, rational(t_min))


def _clip_by_box(lower: Sequence[Any], upper: Sequence[Any], ray: Sequence[Any], t_min: Any) -> tuple[End, End] | None:
    """Clip by a box; all numbers are fmpq."""
    enter, leave = t_min, None
    for low, high, o, d in zip(lower, upper, ray[:3], ray[3:], strict=True):
        if not d:
            if not low <= o <= high:
                return None
            continue
        near, far = sorted(((low - o) / d, (high - o) / d))
        enter = max(enter, near)
        leave = far if leave is None else min(leave, far)
    assert leave is not None, "a direction is never zero"
    return (End(enter), End(leave)) if enter <= leave else None


def _clip_by_sphere(center: Sequence[Any], radius: Any, ray: Sequence[Any], t_min: Any) -> tuple[End, End] | None:
    """Clip by a ball; all numbers are fmpq."""
    offset = [o - c for o, c in zip(ray[:3], center, strict=True)]
    direction = ray[3:]
    a = sum(d * d for d in direction)
    b = sum(o * d for o, d in zip(offset, direction, strict=True))
    c = sum(o * o for o in offset) - radius * radius
    slope, height = a * t_min + b, (a * t_min + 2 * b) * t_min + c  # the parabola's slope and value at t_min
    if b * b < a * c or (slope > 0 and height > 0):  # the ray misses the ball, or has left it before t_min
        return None
    inside = height <= 0 or slope >= 0  # t_enter <= t_min
    enter = End(t_min) if inside else End(quadratic=(a, b, c), side=-1)
    return enter, End(quadratic=(a, b, c), side=1)


@dataclass(frozen=True)
class Clip:
    """Hold enclosures of the clip intervals of n rays; all arrays are [n].

    Where `missed`, it is proved that the interval is empty. Elsewhere, if it is not empty, enter_lower <= t_enter <=
    enter_upper and leave_lower <= t_leave <= leave_upper; ends of which nothing is known are infinite.
    """

    missed: NDArray[np.bool_]
    enter_lower: Floats
    enter_upper: Floats
    leave_lower: Floats
    leave_upper: Floats


def clip_many(domain: Domain, rays: Floats, t_min: float = 0.0) -> Clip:
    """Enclose the clip intervals at t >= `t_min` of rays float64[n, 6] that hold float32 values."""
    with np.errstate(all="ignore"):
        low, high, missed = _slabs(domain, rays) if isinstance(domain, Box) else _chords(domain, rays)
        unknown = ~(np.isfinite(low.mid) & np.isfinite(high.mid) & np.isfinite(low.rad) & np.isfinite(high.rad))
        missed = (missed | (low.lower > high.upper) | (high.upper < t_min)) & ~unknown
        return Clip(
            missed,
            np.where(unknown, -np.inf, np.maximum(low.lower, t_min)),
            np.where(unknown, np.inf, np.maximum(low.upper, t_min)),
            np.where(unknown, -np.inf, high.lower),
            np.where(unknown, np.inf, high.upper),
        )


def _slabs(domain: Box, rays: Floats) -> tuple[Balls, Balls, NDArray[np.bool_]]:
    """Return both ends of the clip intervals by a box, balls [n], and which rays are proved to miss it, bool[n]."""
    origins, directions = rays[:, :3], rays[:, 3:]
    lower, upper = np.asarray(domain.lower), np.asarray(domain.upper)
    parallel = directions == 0.0
    outside = parallel & ((origins < lower) | (origins > upper))
    d = Balls(np.where(parallel, 1.0, directions))
    to_lower, to_upper = ((Balls(side) - Balls(origins)) / d for side in (lower, upper))
    near, far = balls64.minimum(to_lower, to_upper), balls64.maximum(to_lower, to_upper)
    # the largest of several numbers lies between their largest lower and largest upper bounds; an axis along which the
    # ray does not move bounds nothing
    enter = balls64.hull(*(np.where(parallel, -np.inf, bound).max(axis=1) for bound in (near.lower, near.upper)))
    leave = balls64.hull(*(np.where(parallel, np.inf, bound).min(axis=1) for bound in (far.lower, far.upper)))
    return enter, leave, outside.any(axis=1)


def _chords(domain: Sphere, rays: Floats) -> tuple[Balls, Balls, NDArray[np.bool_]]:
    """Return both ends of the clip intervals by a ball, balls [n], and which rays are proved to miss it, bool[n].

    The ends are computed from the point nearest to the centre, so that a distant origin costs no digits.
    """
    middle = nearest(np.asarray(domain.center), rays)
    offset = [point - Balls(c) for point, c in zip(points_at(rays, middle), domain.center, strict=True)]
    direction = [Balls(rays[:, k]) for k in (3, 4, 5)]
    a = direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]
    b = offset[0] * direction[0] + offset[1] * direction[1] + offset[2] * direction[2]
    r = Balls(domain.radius)
    c = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2] - r * r
    discriminant = b * b - a * c
    missed = np.asarray(discriminant.upper < 0.0)
    root = balls64.sqrt(balls64.hull(np.maximum(discriminant.lower, 0.0), np.maximum(discriminant.upper, 0.0)))
    root = Balls(np.where(missed, 0.0, root.mid), np.where(missed, 0.0, root.rad))
    return Balls(middle) + (-b - root) / a, Balls(middle) + (root - b) / a, missed


def nearest(center: Floats, rays: Floats) -> Floats:
    """Return t of the point of each ray nearest to `center`, float64[n].

    Its error is not bounded: it is only a good place to start from.
    """
    d = rays[:, 3:]
    return np.asarray(((center - rays[:, :3]) * d).sum(axis=1) / (d * d).sum(axis=1))


def points_at(rays: Floats, t: Floats) -> list[Balls]:
    """Return o + t·d as balls of the three coordinates, with relative radii of about 2^-51 wherever o is.

    `rays` is float64[n, 6] with float32 values, `t` float64[n] or [n, k]. Raises TypeError if `t` is no array.

    **Theory.** With t = h + l (Veltkamp's split, 26 bits each) and d a float32, h·d and l·d are exact in float64.
    Knuth's two_sum makes o + h·d exact as s + e. So only the sum s + (e + l·d) is rounded. TINY covers products that
    underflow.
    """
    if not isinstance(t, np.ndarray):
        raise TypeError("t must be an array")
    scaled = t * 134217729.0
    high = scaled - (scaled - t)
    low = t - high
    result = []
    for k in range(3):
        o, d = rays[:, k], rays[:, 3 + k]
        if t.ndim == 2:
            o, d = o[:, None], d[:, None]
        product = high * d
        s = o + product
        back = s - o
        error = (o - (s - back)) + (product - back)
        result.append(Balls(s) + (Balls(error) + Balls(low * d, TINY)))
    return result


def recentred(rays: Floats, t: Floats) -> Floats:
    """Return rays float64[n, 6] with their origins moved by `t`, float64[n], and rounded."""
    return np.column_stack([*(p.mid for p in points_at(rays, t)), rays[:, 3:]])
