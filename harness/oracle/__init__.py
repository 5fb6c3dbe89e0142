"""Certify first hits of rays with implicit surfaces: prove that an interval holds the first root, or that none
exists.

`first_hits` sends all rays through a fast path in float64, which accepts only what a rigorous error bound certifies
(`fast`), in parts that several processes may take (`parts`). The rest go one by one through ball arithmetic of rising
precision and exact arithmetic: `slow` for polynomials, `transcendental` and `piecewise` for everything else. What none
of them can prove is UNDECIDED. `reading` turns the parsed formula into a `graph`, of which `program` makes what every
number system runs. The proofs share nothing with the code that generates kernels, so that an error there cannot hide
here.

- The float32 numbers of a ray o + t·d are taken as exact rationals; d is not normalised again.
- A touch is a root of even multiplicity. If f vanishes all along the ray, the answer is a TOUCH at the first t of the
  clip interval, the part of the ray in the domain.
- The first hit is the smallest t with f = 0 in the closed clip interval [max(t_min, t_enter), t_exit]; t_min is 0
  unless given. A start on the surface is a hit at t_min, whether the ray leaves, enters or grazes. A root before t_min
  does not count, even if it is only one float before. If t_min lies behind the domain, the ray misses.
- A polynomial whose coefficients are rational or in one field Q(√d) is always decided, touches and roots exactly at
  clip ends included, unless 4096 bits do not tell two numbers apart: those of a root and an irrational clip end do if
  the two are 2^-1790 domain radii or more apart.
- A function made of polynomials by quotients, square roots, abs, min and max, such as a distance function, is decided
  on all but rare rays (`piecewise`). A hit may lie at a kink, or where a square root's argument is 0. A ray stays
  undecided if f is made of more than 12 different square roots at one place, or if 1536 bits do not decide it. The hit
  is a TOUCH if f keeps its sign across it, is 0 all along behind it, or has no value on one side.
- f may jump: at a floor, at a comparison, and where atan2 goes from −π to π. A jump across 0 is no root. A hit is a t
  at which f is 0, and at the place of a jump f's own value decides. If f is 0 all along behind a jump, the hit is a
  TOUCH where that begins, although f may have another value just there.
- What jumps by floors and comparisons of polynomials, quotients and roots is decided exactly (`piecewise`). Elsewhere a
  jump is passed if f is proved to be off 0 on both of its sides (`jumps`); a ray that meets the surface in the very
  place of the jump, or lies in it, may stay undecided.
- With other constants (π, e) or functions, crossings and misses are decided, and touches if f is written with a
  repeated factor or as an absolute value. A root just where the slope is infinite, such as that of cbrt(x), stays
  undecided.
- Where f's large terms cancel, as in cos² + sin² − 1 + y/10⁹, Taylor series decide crossings and misses (`taylor`). An
  identity, which is 0 all over, stays undecided if it is not one of polynomials and roots.
- A formula of many thousand operations is given fewer trials per ray, so that a ray may stay undecided.
- `following`, `condition`, `margin` and `contrast` are estimates in plain float64 (`classify`).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Surface, Truth
from surfaces.model import is_number

__all__ = ["cached_first_hits", "first_hits"]


def first_hits(surface: Surface, rays: NDArray[np.float32], t_min: float = 0.0) -> Truth:
    """Return the certified first hits at or after `t_min` of rays float32[n, 6]: origins and directions, scene units.

    Chunks of the rays are spread as `harness.spreading.over` says; the answers are the same bits wherever they are
    made on processors of one kind. Raises FirsthitError for rays of another shape or type, with NaN or infinity, or
    with the direction 0, and for a `t_min` that is negative or not finite.
    """
    from harness.oracle.parts import certified

    check_rays(rays)
    return certified(surface, rays, checked_t_min(t_min))


def cached_first_hits(surface: Surface, rays: NDArray[np.float32], folder: Path, t_min: float = 0.0) -> Truth:
    """Return `first_hits`, from a file in `folder` if it is stored there.

    The file's name covers the surface, the rays, t_min and the oracle's own files. A damaged file is replaced; where
    none can be written, `cache.unwritten` says so. Raises FirsthitError as `first_hits`.
    """
    from harness.oracle import cache

    check_rays(rays)
    t_min = checked_t_min(t_min)
    path = cache.truth_path(folder, surface, rays, t_min)
    truth = cache.load(path, len(rays))
    if truth is None:
        truth = first_hits(surface, rays, t_min)
        cache.store(path, truth)
    return truth


def check_rays(rays: NDArray[np.float32]) -> None:
    """Raise FirsthitError, which names the first row that is not a ray."""
    if not isinstance(rays, np.ndarray) or rays.dtype != np.float32 or rays.ndim != 2 or rays.shape[1] != 6:
        found = f"{rays.dtype}{list(rays.shape)}" if isinstance(rays, np.ndarray) else type(rays).__name__
        raise FirsthitError(f"rays must be a float32[n, 6] array of origins and directions, not {found}")
    bad = ~np.isfinite(rays).all(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        raise FirsthitError(f"ray {row} is not finite: {rays[row].tolist()}; remove it or give it six finite numbers")
    idle = ~rays[:, 3:].any(axis=1)
    if idle.any():
        raise FirsthitError(f"ray {int(np.argmax(idle))} has direction (0, 0, 0); give it a direction or remove it")


def checked_t_min(t_min: float) -> float:
    """Return `t_min` as a float64, −0 as 0. Raises FirsthitError if it is negative or no finite number."""
    if not is_number(t_min):
        raise FirsthitError(
            f"t_min must be a number, not {type(t_min).__name__}; give a distance along the ray, 0 or more"
        )
    try:
        value = float(t_min)
    except OverflowError:
        value = np.inf
    if not (np.isfinite(value) and value >= 0.0):
        raise FirsthitError(f"t_min must be finite and not negative, not {value}; rays start at 0")
    return value + 0.0
