"""Choose surfaces of the gallery to hold claims on, and make rays that look for what is hard on a surface."""

from __future__ import annotations

from functools import cache

import numpy as np
import sympy

import surfaces
from harness.contract import Surface, View
from harness.scenes.camera import camera_for, rays_of

HELD_GROUPS = ("singular_points", "singular_curves", "classical")
HELD = (  # of the other groups
    "togliatti",
    "endrass_minus",
    "labs_septic",
    "goursat",
    "crosscap",
    "boy",
    "enneper",
    "gyroid",
    "schwarz_p",
    "scherk",
    "chmutov_octic",
    "chmutov_12",
    "cube_20",
)
EXPANDED = "chmutov_12_expanded"  # a surface of the gallery, written such that it drowns
CANDIDATES = 20_000  # points of the domain that are moved to the surface
STEPS = 8  # of Newton's method along the gradient
FLATTEST = 0.02  # share of the surface's points that count as its tails


@cache
def held() -> tuple[str, ...]:
    """Return the surfaces that claims are held on; tests/test_gallery_facts.py holds the others."""
    names = [name for group in HELD_GROUPS for name in surfaces.names(group)]
    return (*names, *HELD, EXPANDED)


@cache
def surface_named(name: str) -> Surface:
    """Make the surface of this name. Raises FirsthitError where the gallery has none."""
    if name != EXPANDED:
        return surfaces.get(name)
    nested = surfaces.get("chmutov_12")
    expanded = str(sympy.expand(surfaces.expression(nested))).replace("**", "^")
    return surfaces.from_formula(expanded, nested.domain, name=name)


def view_rays(surface: Surface, size: int) -> np.ndarray:
    """Return the rays float32[size * size, 6] of an oblique view of `surface`."""
    return rays_of(camera_for(View("oblique", azimuth=30, elevation=35), surface), size)


@cache
def tails(surface: Surface) -> np.ndarray:
    """Return points float64[k, 3] on the surface or near it where f is flattest.

    There lie thin tails, singular points and singular curves.
    """
    rng = np.random.default_rng(3)
    radius, center = surface.domain.radius, np.array(surface.domain.center)
    points = rng.uniform(-radius, radius, (CANDIDATES, 3)) + center
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            slope = surfaces.gradient(surface, points)
            step = surfaces.evaluate(surface, points)[:, None] * slope / (slope**2).sum(axis=1, keepdims=True)
            points = points - np.clip(np.nan_to_num(step), -0.1 * radius, 0.1 * radius)
        steep = np.linalg.norm(surfaces.gradient(surface, points), axis=1)
    inside = np.linalg.norm(points - center, axis=1) < radius
    points, steep = points[inside], steep[inside]
    return points[np.argsort(steep)[: max(1, int(FLATTEST * len(points)))]]


def aimed(surface: Surface, targets: np.ndarray, count: int, rng: np.random.Generator) -> np.ndarray:
    """Return rays float32[count, 6] that begin two to five radii away and pass points of `targets`, float64[k, 3].

    They pass them at distances from about 1e-4 to 0.1 radii.
    """
    radius, center = surface.domain.radius, np.array(surface.domain.center)
    away = rng.normal(size=(count, 3))
    away *= rng.uniform(2.0, 5.0, (count, 1)) / np.linalg.norm(away, axis=1)[:, None]
    origins = away * radius + center
    aside = rng.normal(size=(count, 3)) * 10.0 ** rng.uniform(-4.0, -1.0, (count, 1)) * radius
    directions = targets[rng.integers(0, len(targets), count)] + aside - origins
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return np.hstack([origins, directions]).astype(np.float32)


def anywhere(surface: Surface, count: int, rng: np.random.Generator) -> np.ndarray:
    """Return rays float32[count, 6] that begin outside the domain and pass near random points of it."""
    points = rng.normal(size=(count, 3))
    points *= rng.uniform(0, 1, (count, 1)) ** (1 / 3) / np.linalg.norm(points, axis=1)[:, None]
    return aimed(surface, points * surface.domain.radius + surface.domain.center, count, rng)
