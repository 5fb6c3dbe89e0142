"""Dense random polynomials of every degree that a method may accept, and rays at them, as cases of conformance.

Catalogs hold few degrees, and formulas that mathematicians like: sparse, even, symmetric. What a fit, a table or a
compiler does at degree 18 with forty terms shows on none of them. A polynomial here is TERMS random monomials of
degrees up to its own, with coefficients in [-1, 1], and 0.8 x^degree, so that its degree is what it says; and a
constant that makes it zero at a point within, so that rays meet it.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np
from numpy.typing import NDArray

from harness.conformance.cases import Bench, Case, refusal
from harness.contract import PRECISIONS, Precision, Surface
from harness.oracle import first_hits
from harness.plugins import Plugin

DEGREES = range(1, 21)
DOMAIN = "sphere:1.1"
TERMS = 40
COUNT = 500  # rays of one polynomial in `firsthit conform`
FAR_AWAY = 4.0  # of an origin outside the domain, in its radii
INNER = 0.9  # of the domain's radius: what rays are aimed at lies within


def formula(degree: int, rng: np.random.Generator) -> str:
    """A random polynomial in x, y, z of that degree, in the formula language."""
    terms = []
    for _ in range(TERMS):
        powers = rng.multinomial(rng.integers(0, degree + 1), [1 / 3] * 3)
        factors = [f"{axis}^{power}" for axis, power in zip("xyz", powers, strict=True) if power]
        terms.append("*".join([f"({rng.uniform(-1.0, 1.0):.6f})", *factors]))
    return " + ".join([*terms, f"0.8*x^{degree}"])


@cache
def surface_of(degree: int, seed: int) -> Surface:
    """The polynomial of a degree and a seed, on DOMAIN, through a random point of the domain's inner half."""
    import surfaces

    rng = np.random.default_rng(seed)
    text = formula(degree, rng)
    loose = surfaces.from_formula(text, DOMAIN)
    inner = rng.uniform(-0.25, 0.25, (1, 3)) * loose.domain.radius
    constant = float(surfaces.evaluate(loose, inner)[0])
    return surfaces.from_formula(f"{text} - ({constant:.6f})", DOMAIN, f"dense_{degree}_{seed}")


def aimed_rays(surface: Surface, count: int, rng: np.random.Generator) -> NDArray[np.float32]:
    """float32[count, 6]: every other ray starts in the domain, the rest outside it; all are aimed at points in it."""
    radius, center = surface.domain.radius, np.array(surface.domain.center)

    def points() -> NDArray[np.float64]:
        ball = rng.normal(size=(count, 3))
        lengths = INNER * rng.random((count, 1)) ** (1 / 3)
        return np.asarray(ball * (lengths / np.linalg.norm(ball, axis=1, keepdims=True)))

    origins = points()
    origins[::2] *= FAR_AWAY / np.linalg.norm(origins[::2], axis=1, keepdims=True)
    directions = points() - origins
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return np.hstack([origins * radius + center, directions]).astype(np.float32)


@cache
def case_of(degree: int, seed: int, count: int) -> Case:
    """A polynomial, `count` rays at it and their certified answers."""
    surface = surface_of(degree, seed)
    rays = aimed_rays(surface, count, np.random.default_rng([seed, degree]))
    return Case(surface, rays, first_hits(surface, rays))


def seed_of(degree: int) -> int:
    """The seed of the polynomial that `firsthit conform` takes for a degree."""
    return 100 * degree + 1


def cases(bench: Bench, plugin: Plugin, count: int = COUNT) -> Iterator[tuple[str, Case, Precision]]:
    """A polynomial of each degree that the method accepts on the bench, in both precisions: where, case, precision, for
    conformance.examine. Each is one more program to compile."""
    for degree in DEGREES:
        surface = surface_of(degree, seed_of(degree))
        for precision in PRECISIONS:
            if refusal(plugin, surface, precision, bench) is None:
                yield f"dense degree {degree} {precision}", case_of(degree, seed_of(degree), count), precision
