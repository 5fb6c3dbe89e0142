"""Test a distance that is stated of a surface, before a method relies on it.

Nobody can prove a distance of an arbitrary formula. But each certified hit is a point of the surface, so that nowhere
the distance may be greater than the way to the nearest of them; and its sign must be f's.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Surface, TruthStatus
from harness.oracle import first_hits

RAYS = 512  # that look for points of the surface
POINTS = 4096  # at which the distance is held against them
SLACK = 1e-9  # relative, and over the domain's radius: more than float64 loses on the way
Floats = NDArray[np.float64]


@lru_cache(maxsize=128)
def refutation(surface: Surface) -> str | None:
    """Say at which point the distance of a surface is wrong; None where the test finds none, or none is needed.

    None is needed where f is proved to be a distance bound, and for the catalog's distances, which tests recompute.
    """
    from surfaces.evaluation import evaluate, evaluate_tape
    from surfaces.formula import parse
    from surfaces.lowering import real_tape

    if surface.distance is None or _known(surface):
        return None
    rng = np.random.default_rng(1)
    on, error, before = _hits(surface, rng)
    points = np.concatenate((before, _inside(surface, rng, POINTS - len(before))))
    stated = evaluate_tape(real_tape(parse(surface.distance, dict(surface.parameters))), points)[:, 0]
    away = _away(points, on, error) + SLACK * surface.domain.radius
    ratio = np.where(np.isnan(stated), np.inf, np.abs(stated) / (away * (1.0 + SLACK)))
    worst = int(np.argmax(ratio))
    head = f"the distance stated of {surface.name}"
    if ratio[worst] > 1.0:
        return (
            f"{head} is {abs(stated[worst]):.6g} at {_told(points[worst])}, where the surface is {away[worst]:.6g} away"
        )
    values = evaluate(surface, points)
    clear = np.abs(stated) > 1e-6 * surface.domain.radius
    other = clear & ((values < 0.0) != (stated < 0.0)) & (np.abs(values) > 1e-9 * np.abs(values).max(initial=0.0))
    if other.any():
        at = int(np.argmax(np.where(other, np.abs(stated), -1.0)))
        return f"{head} is {stated[at]:.6g} at {_told(points[at])}, where f is {values[at]:.6g}: its sign must be f's"
    return None


def _known(surface: Surface) -> bool:
    """Return whether a distance is proved, or recomputed by tests."""
    import surfaces
    from surfaces.proofs.lipschitz import is_distance_bound

    if surface.distance == surface.formula and is_distance_bound(surfaces.tape_of(surface), surface.domain):
        return True
    catalog = map(surfaces.get, surfaces.names())
    return any((s.formula, s.distance) == (surface.formula, surface.distance) for s in catalog)


def _told(point: Floats) -> str:
    return f"({', '.join(f'{value:.6g}' for value in point)})"


def _inside(surface: Surface, rng: np.random.Generator, count: int) -> Floats:
    """Return random points of the domain, float64[count, 3]."""
    domain = surface.domain
    if isinstance(domain, Box):
        return rng.uniform(domain.lower, domain.upper, (count, 3))
    heading = rng.normal(size=(count, 3))
    heading /= np.linalg.norm(heading, axis=1)[:, None]
    return np.asarray(domain.center + domain.radius * np.cbrt(rng.random((count, 1))) * heading)


def _hits(surface: Surface, rng: np.random.Generator) -> tuple[Floats, Floats, Floats]:
    """Return certified points of the surface [n, 3], the errors of each [n], and points of the rays before them."""
    domain = surface.domain
    heading = rng.normal(size=(RAYS, 3))
    heading /= np.linalg.norm(heading, axis=1)[:, None]
    origins = _inside(surface, rng, RAYS) - 2.0 * domain.radius * heading * (rng.random((RAYS, 1)) < 0.5)
    rays = np.concatenate((origins, heading), axis=1).astype(np.float32)
    truth = first_hits(surface, rays)
    hit = np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH))
    o, d = rays[hit, :3].astype(np.float64), rays[hit, 3:].astype(np.float64)
    t, half = 0.5 * (truth.lower + truth.upper)[hit], 0.5 * (truth.upper - truth.lower)[hit]
    before = o + (t * rng.random(len(t)) ** 0.5)[:, None] * d
    return o + t[:, None] * d, half * np.linalg.norm(d, axis=1), before[_in_domain(surface, before)]


def _in_domain(surface: Surface, points: Floats) -> NDArray[np.bool_]:
    from surfaces.proofs.boxes import outside

    return ~outside(surface.domain, points, points)


def _away(points: Floats, on: Floats, error: Floats) -> Floats:
    """Bound each point's distance to the nearest certified hit from above, float64[n]; infinite without hits."""
    away = np.full(len(points), np.inf)
    for start in range(0, len(on), 64):
        gaps = np.linalg.norm(points[:, None] - on[None, start : start + 64], axis=2) + error[start : start + 64]
        away = np.minimum(away, gaps.min(axis=1))
    return away
