"""The catalog's facts, recomputed: a wrong transcription renders plausibly."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import sympy

import surfaces
from harness.contract import Box, FirsthitError, Sphere, Surface
from surfaces import formula, lowering
from surfaces.entries import SYMMETRIES
from surfaces.evaluation import evaluate_tape
from surfaces.proofs.validity import check

from .facts import scattered, singular_points

CATALOG = [surfaces.get(name) for name in surfaces.names()]
each = pytest.mark.parametrize("surface", CATALOG, ids=lambda s: s.name)


def test_at_least_32_with_the_papers_among_them() -> None:
    papers = "sphere torus flirt calyx barth_sextic endrass_octic barth_decic sixteen_ball dingdong_beamcasting klein"
    papers += (
        " mitchell octdong steiner tangle teardrop heart chmutov blinn_blob clebsch cayley ding_dong monkey_saddle"
    )
    assert len(surfaces.names()) >= 32
    assert set(papers.split()) <= set(surfaces.names())


@each
def test_is_defined_over_its_domain(surface: Surface) -> None:
    check(surface)


@each
def test_degree(surface: Surface) -> None:
    """By the ball expansion along a line, and by sympy's expansion."""
    assert formula.degree(surfaces.tape_of(surface)) == surface.degree
    expression = sympy.expand(surfaces.expression(surface))
    polynomial = expression.is_polynomial(formula.X, formula.Y, formula.Z)
    assert polynomial == surface.algebraic
    if polynomial:
        terms = sympy.Poly(expression, formula.X, formula.Y, formula.Z, domain="EX").terms()
        assert max(sum(powers) for powers, factor in terms if sympy.nsimplify(factor) != 0) == surface.degree


@each
def test_symmetries(surface: Surface) -> None:
    points = scattered(surface, 40)
    values = surfaces.evaluate(surface, points)
    names = dict(surface.facts).get("symmetries", ())
    assert names, "every surface here has a symmetry that a wrong sign or exponent would break"
    for name in names:
        matrix = np.array(SYMMETRIES[name], float)
        assert np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
        moved = surfaces.evaluate(surface, points @ matrix.T)
        assert np.allclose(moved, values, rtol=1e-9, atol=1e-9 * np.abs(values).max()), name


@each
def test_points(surface: Surface) -> None:
    points = np.array(dict(surface.facts).get("points", ()), float).reshape(-1, 3)
    scale = np.abs(surfaces.evaluate(surface, scattered(surface, 100))).max()
    assert np.all(np.abs(surfaces.evaluate(surface, points)) <= 1e-14 * scale)


@pytest.mark.parametrize("surface", [s for s in CATALOG if "singular_points" in dict(s.facts)], ids=lambda s: s.name)
def test_number_of_singular_points(surface: Surface) -> None:
    found = singular_points(surface)
    assert len(found) == dict(surface.facts)["singular_points"]
    if isinstance(surface.domain, Sphere):
        assert np.all(np.linalg.norm(found - surface.domain.center, axis=1) <= surface.domain.radius)


@pytest.mark.parametrize(
    "surface", [s for s in CATALOG if {"singular_along", "singular_at"} & set(dict(s.facts))], ids=lambda s: s.name
)
def test_singular_curves(surface: Surface) -> None:
    facts = dict(surface.facts)
    lines = [
        t * np.array(d, float) for d, t in itertools.product(facts.get("singular_along", ()), (-1.3, 0.0, 0.4, 2.0))
    ]
    points = np.array([*lines, *facts.get("singular_at", ())], float)
    assert np.allclose(surfaces.evaluate(surface, points), 0.0, atol=1e-10)
    assert np.allclose(surfaces.gradient(surface, points), 0.0, atol=1e-10)


@each
def test_the_surface_is_seen_in_its_domain(surface: Surface) -> None:
    """f changes sign in the domain, or vanishes there to second order."""
    points = scattered(surface, 60000)
    if isinstance(surface.domain, Box):
        points = np.random.default_rng(1).uniform(surface.domain.lower, surface.domain.upper, (60000, 3))
    else:
        points = points[np.linalg.norm(points - surface.domain.center, axis=1) < surface.domain.radius]
    values = surfaces.evaluate(surface, points)
    if surface.name == "plane_squared":
        assert values.min() >= 0.0
    elif surface.name == "two_spheres":  # the shell between the spheres is 5e-5 thin
        assert surfaces.evaluate(surface, np.array([[0.0, 1.000025, 0.0]]))[0] < 0.0 < values.max()
    elif surface.name.startswith("thin_torus"):
        assert surfaces.evaluate(surface, np.array([[1.0, 0.0, 0.0]]))[0] < 0.0 < values.max()
    else:
        assert values.min() < 0.0 < values.max()


@pytest.mark.parametrize("surface", [s for s in CATALOG if s.distance], ids=lambda s: s.name)
def test_distance(surface: Surface) -> None:
    """Zero where f is, of the sign of f, and of unit slope."""
    assert surface.distance is not None
    tape = lowering.real_tape(formula.parse(surface.distance, dict(surface.parameters)))
    points = scattered(surface, 3000)
    distance = evaluate_tape(tape, points)[:, 0]
    slope = evaluate_tape(lowering.gradient(tape), points)
    assert np.allclose(np.linalg.norm(slope, axis=1), 1.0, atol=1e-9)
    feet = points - distance[:, None] * slope
    scale = np.abs(surfaces.evaluate(surface, points)).max()
    assert np.all(np.abs(surfaces.evaluate(surface, feet)) < 1e-10 * scale)
    away = np.abs(distance) > 1e-6
    assert np.all(np.sign(distance[away]) == np.sign(surfaces.evaluate(surface, points[away])))


@pytest.mark.parametrize("surface", [s for s in CATALOG if s.bounding_radius], ids=lambda s: s.name)
def test_bounding_radius(surface: Surface) -> None:
    """f keeps one sign on rays from the bounding sphere outwards, to twice the domain's radius."""
    assert surface.bounding_radius is not None
    directions = np.random.default_rng(3).normal(size=(4000, 3))
    directions = np.vstack([directions, np.array(list(itertools.product((-1.0, 0.0, 1.0), repeat=3)))])
    directions = directions[np.linalg.norm(directions, axis=1) > 0.0]
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    for factor in np.linspace(1.0 + 1e-9, 2.0, 20):
        points = directions * surface.bounding_radius * factor + surface.domain.center
        assert np.all(surfaces.evaluate(surface, points) > 0.0)


def test_parameters_bind_and_are_checked() -> None:
    torus = surfaces.get("torus", R=0.5, r="0.25")
    assert torus.domain == Box((-0.75, -0.75, -0.25), (0.75, 0.75, 0.25))
    assert (torus.bounding_radius, torus.feature_radius) == (0.75, 0.25)
    assert surfaces.evaluate(torus, np.array([[0.75, 0.0, 0.0]]))[0] == 0.0
    assert surfaces.get("torus") != torus and surfaces.get("torus", R="0.5", r="0.25") == torus
    for name, parameters, reason in (
        ("toras", {}, "did you mean torus"),
        ("qqqq", {}, "list surfaces"),
        ("torus", {"Q": "1"}, "known: R, r"),
        ("barth_sextic", {"w": "1"}, "it takes none"),
        ("torus", {"R": "0"}, "must be positive"),
        ("torus", {"R": "nan"}, "parameter R: 'nan' is not a decimal number"),
        ("torus", {"R": float("inf")}, "parameter R: 'inf' is not"),
        ("kummer", {"mu2": "1"}, "not 1"),
    ):
        with pytest.raises(FirsthitError, match=reason):
            surfaces.get(name, **parameters)
