"""Certify rays in three steps, each of which can be spread over processes: the fast path, the slow path, estimates.

**Why the answers are the same bits wherever they are made.** The fast path and the estimates compute on many rays at
once. They always take the same blocks of rays, whoever takes which. The slow path takes rays one by one. So it makes no
difference which process answers a part, nor how many there are. Only another processor may round numpy's functions
otherwise.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness import spreading
from harness.contract import Surface, Truth, TruthStatus, digest
from harness.oracle.balls64 import Floats
from harness.oracle.classify import BLOCK as CLASSIFIED
from harness.oracle.classify import Estimates, classify
from harness.oracle.fast import FastAnswers
from harness.oracle.slow import FirstHit

MOST_SLOW = 16  # rays of the slow path that are one chunk
LEAST_CHUNKS = 256  # of the slow path, if there are as many rays: one of them may take 1000 times as long as another
Rays = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class _Chunk:
    """Hold rays float32[k, 6] of a surface and, for the estimates, their first hits [k]."""

    surface: Surface
    rays: Rays
    t_min: float
    first: Floats | None = None
    status: NDArray[np.uint8] | None = None


def certified(surface: Surface, rays: Rays, t_min: float) -> Truth:
    """Return the certified first hits of rays float32[n, 6], which have been checked."""
    solver = solver_of(surface)
    pieces = [
        _Chunk(surface, rays[k : k + solver.fast.block], t_min) for k in range(0, max(len(rays), 1), solver.fast.block)
    ]
    fast = FastAnswers.joined(spreading.answers(_fast, pieces, solver.seconds))
    slow = np.flatnonzero(~fast.decided)
    if len(slow):
        size = min(MOST_SLOW, 1 + len(slow) // LEAST_CHUNKS)
        parts = [slow[k : k + size] for k in range(0, len(slow), size)]
        found = spreading.answers(_slow, [_Chunk(surface, rays[part], t_min) for part in parts], solver.seconds)
        fast.lower[slow], fast.upper[slow], fast.status[slow] = (
            np.concatenate(column) for column in zip(*found, strict=True)
        )
    first = 0.5 * (fast.lower + fast.upper)
    blocks = [slice(k, k + CLASSIFIED) for k in range(0, max(len(rays), 1), CLASSIFIED)]
    pieces = [_Chunk(surface, rays[part], t_min, first[part], fast.status[part]) for part in blocks]
    estimates = spreading.answers(_estimated, pieces, solver.seconds)
    return Truth(
        fast.lower, fast.upper, fast.status, *(np.concatenate(column) for column in zip(*estimates, strict=True))
    )


def _fast(chunk: _Chunk) -> FastAnswers:
    return solver_of(chunk.surface).fast.first_hits(chunk.rays.astype(np.float64), chunk.t_min)


def _slow(chunk: _Chunk) -> tuple[Floats, Floats, NDArray[np.uint8]]:
    """Return lower, upper and status, [k] each."""
    hits = [solver_of(chunk.surface).slow_hit(ray.tolist(), chunk.t_min) for ray in chunk.rays.astype(np.float64)]
    lower, upper = (np.array([getattr(hit, end) for hit in hits]) for end in ("lower", "upper"))
    return lower, upper, np.array([hit.status for hit in hits], np.uint8)


def _estimated(chunk: _Chunk) -> Estimates:
    solver, wide = solver_of(chunk.surface), chunk.rays.astype(np.float64)
    assert chunk.first is not None and chunk.status is not None
    stated = solver.floats, solver.fast.f, solver.noise, chunk.surface.domain
    return classify(*stated, wide, chunk.first, chunk.status, chunk.t_min)


class Solver:
    """Hold a surface's fast and slow paths, which are built once, in `seconds`."""

    def __init__(self, surface: Surface) -> None:
        import surfaces
        from harness.oracle.enclosure import Enclosure
        from harness.oracle.fast import FastSolver
        from harness.oracle.floats import FloatFunction
        from harness.oracle.noise import Noise
        from harness.oracle.program import program_of
        from harness.oracle.reading import graph_of
        from harness.oracle.slow import AlgebraicSolver
        from harness.oracle.transcendental import SmoothSolver

        began = time.perf_counter()
        graph = graph_of(surfaces.tape_of(surface))
        program = program_of(graph)
        self.fast = FastSolver(graph, surface.domain)
        self.floats = FloatFunction(program, [c.mid for c in Enclosure(program).constants])
        self.noise = Noise(surface)
        smooth = SmoothSolver(graph, surface.domain)
        self.slow: list[AlgebraicSolver | SmoothSolver] = [smooth]
        if program.is_polynomial:  # coefficients in several fields Q(√d): the other one decides more
            self.slow = [AlgebraicSolver(program, surface.domain), *([smooth] if smooth.exact else [])]
        self.seconds = time.perf_counter() - began

    def slow_hit(self, ray: list[float], t_min: float) -> FirstHit:
        """Return the first hit of one ray, o and d, that the fast path left open."""
        for solver in self.slow:
            hit = solver.first_hit(ray, t_min)
            if hit.status != TruthStatus.UNDECIDED:
                break
        return hit


_SOLVERS: dict[str, Solver] = {}


def solver_of(surface: Surface) -> Solver:
    """Return the surface's solver, which is built once in each process."""
    key = digest(surface.identity)
    if key not in _SOLVERS:
        _SOLVERS[key] = Solver(surface)
    return _SOLVERS[key]
