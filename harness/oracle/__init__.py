"""Certified first hits of rays with implicit surfaces: intervals proved to hold the first root, or proof of a miss.

`first_hits` sends all rays through a float64 fast path that accepts only what a rigorous error bound certifies
(`fast`), then the rest one by one through ball arithmetic of rising precision and exact arithmetic (`slow` for
polynomials, `transcendental` for everything else). What neither can prove is UNDECIDED.

- The ray o + t·d is taken with float32 numbers as the exact rationals they are; d is not renormalised.
- A touch is a root of even multiplicity. Where f vanishes all along the ray, the answer is a TOUCH at the clip
  interval's first t.
- The first hit is the smallest t with f = 0 in the closed interval [max(t_min, t_enter), t_exit] that the ray spends in
  the domain; t_min is 0 unless given. A start on the surface is a hit at t_min, whether the ray leaves, enters or
  grazes, unless t_min excludes it: a root before t_min is none, be it by one float. Where t_min lies behind the domain,
  the ray misses.
- A polynomial whose coefficients are rational or in one field Q(√d) is always decided (touches and roots exactly at
  clip ends included) up to the 4096 bits at which telling two numbers apart is given up.
- So is, but for rare rays, what is made of polynomials by quotients, square roots, abs, min and max, such as a distance
  function (`piecewise`): a hit may lie at a kink, or where a square root's argument is 0. Given up are rays on which f
  is made of more than 12 different square roots at one place, or that 1536 bits do not decide. Where f keeps its sign
  across a hit, or is 0 all along behind it, or has no value on one side, the hit is a TOUCH.
- With other constants (π, e) or functions, crossings and misses are decided, and touches where f is written with a
  repeated factor or as an absolute value.
- `following`, `condition`, `margin` and `contrast` are estimates in plain float64 (`classify`).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Surface, Truth, TruthStatus, digest

__all__ = ["cached_first_hits", "first_hits"]


def first_hits(surface: Surface, rays: NDArray[np.float32], t_min: float = 0.0) -> Truth:
    """Certified first hits for `rays`: float32[n, 6], origin and direction in scene units, at `t_min` or beyond.

    A FirsthitError for rays of another shape or type, with NaN or infinity, or without a direction, and for a `t_min`
    that is negative or not finite.
    """
    from harness.oracle.classify import classify

    check_rays(rays)
    t_min = checked_t_min(t_min)
    solver = _solver(surface)
    wide = rays.astype(np.float64)
    lower, upper, status = solver.certify(wide, t_min)
    first = 0.5 * (lower + upper)
    estimates = classify(solver.floats, solver.fast.f, solver.noise, surface.domain, wide, first, status, t_min)
    return Truth(lower, upper, status, *estimates)


def cached_first_hits(surface: Surface, rays: NDArray[np.float32], folder: Path, t_min: float = 0.0) -> Truth:
    """`first_hits`, kept in `folder` by content, the oracle's own files among it; a damaged file is replaced."""
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
    """A FirsthitError naming the first row that is not a ray."""
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
    """`t_min` as a float64, −0 as 0; a FirsthitError where it is no finite number, or negative."""
    if isinstance(t_min, bool) or not isinstance(t_min, int | float | np.integer | np.floating):
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


class _Solver:
    """A surface's fast and slow paths, built once."""

    def __init__(self, surface: Surface) -> None:
        import surfaces
        from harness.oracle.enclosure import Enclosure
        from harness.oracle.fast import FastSolver
        from harness.oracle.floats import FloatFunction
        from harness.oracle.noise import Noise
        from harness.oracle.program import compile_expression
        from harness.oracle.slow import AlgebraicSolver
        from harness.oracle.transcendental import SmoothSolver

        expr = surfaces.expression(surface)
        program = compile_expression(expr)
        self.fast = FastSolver(expr, surface.domain)
        self.floats = FloatFunction(program, [c.mid for c in Enclosure(program).constants])
        self.noise = Noise(surface)
        smooth = SmoothSolver(expr, surface.domain)
        self.slow: list[AlgebraicSolver | SmoothSolver] = [smooth]
        if program.is_polynomial:  # in several fields Q(√d), what balls leave open is for the other one
            self.slow = [AlgebraicSolver(program, surface.domain), *([smooth] if smooth.exact else [])]

    def certify(
        self, rays: NDArray[np.float64], t_min: float
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.uint8]]:
        """lower, upper and status of `rays`: float64[n, 6] holding float32 values."""
        fast = self.fast.first_hits(rays, t_min)
        for row in np.flatnonzero(~fast.decided):
            for solver in self.slow:
                hit = solver.first_hit(rays[row].tolist(), t_min)
                if hit.status != TruthStatus.UNDECIDED:
                    break
            fast.lower[row], fast.upper[row], fast.status[row] = hit.lower, hit.upper, hit.status
        return fast.lower, fast.upper, fast.status


_SOLVERS: dict[str, _Solver] = {}


def _solver(surface: Surface) -> _Solver:
    key = digest(surface.identity)
    if key not in _SOLVERS:
        _SOLVERS[key] = _Solver(surface)
    return _SOLVERS[key]
