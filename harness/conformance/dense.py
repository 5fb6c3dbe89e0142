"""Make test cases from dense random polynomials of every degree that a method may accept.

The surfaces of the catalog have few different degrees, and their formulas are sparse, even or symmetric. None of them
shows what a fit, a table or a compiler does at degree 18 with forty terms. A polynomial of this module is the sum of

- TERMS random monomials of degrees up to its own, with coefficients in [-1, 1],
- 0.8 x^degree, so that the polynomial has that degree, and
- a constant that makes it zero at a point inside the domain, so that rays meet the surface.
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
FAR_AWAY = 4.0  # domain radii: how far an origin outside the domain is from its centre
INNER = 0.9  # domain radii: the points that rays are aimed at are nearer to the centre


def formula(degree: int, rng: np.random.Generator) -> str:
    """Return a random polynomial of that degree in x, y and z, in the formula language."""
    terms = []
    for _ in range(TERMS):
        powers = rng.multinomial(rng.integers(0, degree + 1), [1 / 3] * 3)
        factors = [f"{axis}^{power}" for axis, power in zip("xyz", powers, strict=True) if power]
        terms.append("*".join([f"({rng.uniform(-1.0, 1.0):.6f})", *factors]))
    return " + ".join([*terms, f"0.8*x^{degree}"])


@cache
def surface_of(degree: int, seed: int) -> Surface:
    """Return the polynomial of a degree and a seed, on DOMAIN, which is zero at a random point near the centre."""
    import surfaces

    rng = np.random.default_rng(seed)
    text = formula(degree, rng)
    loose = surfaces.from_formula(text, DOMAIN)
    inner = rng.uniform(-0.25, 0.25, (1, 3)) * loose.domain.radius
    constant = float(surfaces.evaluate(loose, inner)[0])
    return surfaces.from_formula(f"{text} - ({constant:.6f})", DOMAIN, f"dense_{degree}_{seed}")


def aimed_rays(surface: Surface, count: int, rng: np.random.Generator) -> NDArray[np.float32]:
    """Return rays float32[count, 6] at points in the domain; the even ones start outside it, the odd ones inside."""
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
    """Make the case of a polynomial, with `count` rays at it and their certified answers."""
    surface = surface_of(degree, seed)
    rays = aimed_rays(surface, count, np.random.default_rng([seed, degree]))
    return Case(surface, rays, first_hits(surface, rays))


def seed_of(degree: int) -> int:
    """Return the seed of the polynomial of a degree that `firsthit conform` takes."""
    return 100 * degree + 1


def cases(bench: Bench, plugin: Plugin, count: int = COUNT) -> Iterator[tuple[str, Case, Precision]]:
    """Yield what is checked, the case and the precision, for each degree that the method accepts on the bench.

    Each of these is one more program to compile.
    """
    for degree in DEGREES:
        surface = surface_of(degree, seed_of(degree))
        for precision in PRECISIONS:
            if refusal(plugin, surface, precision, bench) is None:
                yield f"dense degree {degree} {precision}", case_of(degree, seed_of(degree), count), precision
