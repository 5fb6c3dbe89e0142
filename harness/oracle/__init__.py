"""Certified first hits of rays with implicit surfaces: intervals proved to hold the first root, or proof of a miss.

`first_hits` sends all rays through a float64 fast path that accepts only what a rigorous error bound certifies
(`fast`), then the rest one by one through ball arithmetic of rising precision and exact arithmetic (`slow` for
polynomials, `transcendental` for everything else). What neither can prove is UNDECIDED.

- The ray o + t·d is taken with float32 numbers as the exact rationals they are; d is not renormalised.
- A touch is a root of even multiplicity. Where f vanishes all along the ray, the answer is a TOUCH at the clip
  interval's first t.
- A surface whose coefficients are rational or in one field Q(√d) is always decided (touches and roots exactly at clip
  ends included) up to the 4096 bits at which telling two numbers apart is given up; one with other constants, or that
  is no polynomial, has its crossings and misses decided, and its touches where f is written with a repeated factor.
- `following`, `condition`, `margin` and `contrast` are estimates in plain float64 (`classify`).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Surface, Truth, digest

ORACLE_VERSION = 4  # raise when answers or estimates change: old cache files are then not found

__all__ = ["ORACLE_VERSION", "cached_first_hits", "first_hits"]


def first_hits(surface: Surface, rays: NDArray[np.float32]) -> Truth:
    """Certified first hits for `rays`: float32[n, 6], origin and direction in scene units.

    A FirsthitError for rays of another shape or type, with NaN or infinity, or without a direction.
    """
    from harness.oracle.classify import classify

    check_rays(rays)
    solver = _solver(surface)
    wide = rays.astype(np.float64)
    lower, upper, status = solver.certify(wide)
    first = 0.5 * (lower + upper)
    estimates = classify(solver.floats, solver.fast.f, solver.noise, surface.domain, wide, first, status)
    return Truth(lower, upper, status, *estimates)


def cached_first_hits(surface: Surface, rays: NDArray[np.float32], folder: Path) -> Truth:
    """`first_hits`, kept in `folder` by content; a damaged file is computed anew and replaced."""
    from harness.oracle import cache

    check_rays(rays)
    path = cache.truth_path(folder, surface, rays, ORACLE_VERSION)
    truth = cache.load(path, len(rays))
    if truth is None:
        truth = first_hits(surface, rays)
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
        self.slow = (AlgebraicSolver if program.is_polynomial else SmoothSolver)(program, surface.domain)

    def certify(self, rays: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.uint8]]:
        """lower, upper and status of `rays`: float64[n, 6] holding float32 values."""
        fast = self.fast.first_hits(rays)
        for row in np.flatnonzero(~fast.decided):
            hit = self.slow.first_hit(rays[row].tolist())
            fast.lower[row], fast.upper[row], fast.status[row] = hit.lower, hit.upper, hit.status
        return fast.lower, fast.upper, fast.status


_SOLVERS: dict[str, _Solver] = {}


def _solver(surface: Surface) -> _Solver:
    key = digest(surface.identity)
    if key not in _SOLVERS:
        _SOLVERS[key] = _Solver(surface)
    return _SOLVERS[key]
