"""The gallery's facts, recomputed, and a few rays of those of its surfaces that tests/test_gallery.py leaves out.

FIRSTHIT_FACTS=all also counts the nodes and casts the rays that take longest, which is a minute more.
"""

from __future__ import annotations

import itertools
import os

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import Wrong, judge
from harness.contract import Box, FirsthitError, TruthStatus
from harness.kernels.functions import unsupported
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import scene_radius
from surfaces import formula, lowering
from surfaces.entries import SYMMETRIES
from surfaces.evaluation import evaluate_tape
from surfaces.gallery.polynomials import chebyshev, doubled, folded, folding
from surfaces.proofs.validity import check

from .conftest import opened, usable_devices
from .facts import scattered, singular_points
from .gallery import held, surface_named, view_rays
from .test_devices import cast

ALL = os.environ.get("FIRSTHIT_FACTS") == "all"
GALLERY = [surfaces.get(name) for name in surfaces.names("gallery")]
SLOW_TO_COUNT = {"folded_nonic", "folded_dodecic", "chmutov_octic_nodal", "chmutov_12", "chmutov_16", "chmutov_20"}
COUNTED = [s for s in GALLERY if dict(s.facts).get("singular_points", 0 if ALL else None)]
COUNTED += [s for s in GALLERY if ALL and dict(s.facts).get("singular_points") == 0]
COUNTED = [s for s in COUNTED if ALL or s.name not in SLOW_TO_COUNT]
DRAWN = [name for name in surfaces.names("gallery") if name not in held()]
METHODS = ("interval_march", "newton")  # one that claims no missed root, and a fast one
SIDE = 12  # of a picture
each = pytest.mark.parametrize("surface", GALLERY, ids=lambda s: s.name)


def inside(surface, count):
    """Points float64[n, 3] of the domain, n at most `count`."""
    points = scattered(surface, count)
    if isinstance(surface.domain, Box):
        return np.random.default_rng(1).uniform(surface.domain.lower, surface.domain.upper, (count, 3))
    return points[np.linalg.norm(points - surface.domain.center, axis=1) < surface.domain.radius]


def test_there_are_at_least_forty_beyond_the_catalog_in_groups():
    assert len(surfaces.names()) == 36, "the catalog stays as it is"
    assert not set(surfaces.names()) & set(surfaces.names("gallery"))
    groups = [name for name in surfaces.groups() if name != "catalog"]
    assert sum((surfaces.names(group) for group in groups), ()) and len(GALLERY) >= 40
    assert sorted(itertools.chain(*map(surfaces.names, groups))) == list(surfaces.names("gallery"))
    assert {s.degree for s in GALLERY} >= {3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 16, 20, None}
    assert all(surface.group in groups and surface.name in surfaces.names(surface.group) for surface in GALLERY)
    assert {surfaces.get(name).group for name in surfaces.names()} == {"catalog"}
    assert surfaces.from_formula("x - 1/2").group is None


def test_an_unknown_group_or_name_is_answered_with_what_there_is():
    with pytest.raises(FirsthitError, match=r"no group 'nodule'; did you mean 'nodal'\?"):
        surfaces.names("nodule")
    with pytest.raises(FirsthitError, match="did you mean gyroid"):
        surfaces.get("gyrod")
    with pytest.raises(FirsthitError, match="it takes none"):
        surfaces.get("gyroid", a="1")


def test_no_polynomial_of_the_gallery_is_in_the_catalog_or_twice():
    texts = [surfaces.get(name) for name in surfaces.names()] + GALLERY
    points = np.random.default_rng(7).uniform(-1.0, 1.0, (12, 3))
    seen = {}
    for surface in texts:
        values = surfaces.evaluate(surface, points)
        key = tuple(np.round(values / values[0], 9))
        assert key not in seen, f"{surface.name} is {seen[key]} times a number"
        seen[key] = surface.name


@each
def test_is_defined_and_of_the_degree_stated(surface):
    check(surface)
    assert formula.degree(surfaces.tape_of(surface)) == surface.degree
    assert surface.title and surface.source


@each
def test_symmetries_and_points(surface):
    """Each surface states a symmetry or points of it: a wrong sign or exponent would break one."""
    facts = dict(surface.facts)
    assert facts.get("symmetries") or facts.get("points")
    points = scattered(surface, 40)
    values = surfaces.evaluate(surface, points)
    scale = np.abs(values).max()
    for name in facts.get("symmetries", ()):
        moved = surfaces.evaluate(surface, points @ np.array(SYMMETRIES[name], float).T)
        assert np.allclose(moved, values, rtol=1e-9, atol=1e-9 * scale), name
    on = np.array(facts.get("points", ()), float).reshape(-1, 3)
    assert np.all(np.abs(surfaces.evaluate(surface, on)) <= 1e-14 * scale)


@each
def test_the_surface_is_seen_in_its_domain(surface):
    values = surfaces.evaluate(surface, inside(surface, 20_000))
    assert values.min() < 0.0 < values.max()


@pytest.mark.parametrize("surface", COUNTED, ids=lambda s: s.name)
def test_number_of_singular_points(surface):
    """As many as the literature counts; that a surface has none is looked for on request."""
    stated = dict(surface.facts)["singular_points"]
    count = max(1000, 20 * stated)
    starts = inside(surface, count) if isinstance(surface.domain, Box) else scattered(surface, count, 1.05)
    assert len(singular_points(surface, starts)) == stated


@pytest.mark.parametrize("surface", [s for s in GALLERY if "singular_within" in dict(s.facts)], ids=lambda s: s.name)
def test_number_of_singular_points_within_a_radius(surface):
    radius, stated = dict(surface.facts)["singular_within"]
    found = singular_points(surface, np.vstack([scattered(surface, 1500, 1.05), scattered(surface, 1500, 3.0)]))
    assert (np.linalg.norm(found - surface.domain.center, axis=1) < radius).sum() == stated


@pytest.mark.parametrize(
    "surface", [s for s in GALLERY if {"singular_along", "singular_at"} & set(dict(s.facts))], ids=lambda s: s.name
)
def test_singular_curves(surface):
    facts = dict(surface.facts)
    lines = [t * np.array(d, float) for d in facts.get("singular_along", ()) for t in (-1.3, 0.0, 0.4, 2.0)]
    points = np.array([*lines, *facts.get("singular_at", ())], float)
    assert np.allclose(surfaces.evaluate(surface, points), 0.0, atol=1e-10)
    assert np.allclose(surfaces.gradient(surface, points), 0.0, atol=1e-10)


@pytest.mark.parametrize("surface", [s for s in GALLERY if s.distance], ids=lambda s: s.name)
def test_a_distance_has_fs_sign_and_no_point_of_the_surface_is_nearer(surface):
    """f keeps its sign on the sphere about a point whose radius is the distance there, and in half of it."""
    tape = lowering.real_tape(formula.parse(surface.distance, dict(surface.parameters)))
    points = inside(surface, 3000)
    distance = evaluate_tape(tape, points)[:, 0]
    values = surfaces.evaluate(surface, points)
    away = np.abs(distance) > 1e-9
    points, distance, sign = points[away], distance[away], np.sign(values[away])
    assert np.array_equal(np.sign(distance), sign)
    directions = np.random.default_rng(2).normal(size=(24, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    for part in (0.5, 1.0 - 1e-9):
        for direction in directions:
            near = points + part * np.abs(distance)[:, None] * direction
            assert np.array_equal(np.sign(surfaces.evaluate(surface, near)), sign)


@pytest.mark.parametrize("surface", [s for s in GALLERY if s.bounding_radius], ids=lambda s: s.name)
def test_bounding_radius(surface):
    directions = np.random.default_rng(3).normal(size=(1000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    for factor in np.linspace(1.0 + 1e-9, 2.0, 20):
        points = directions * surface.bounding_radius * factor + surface.domain.center
        assert np.all(surfaces.evaluate(surface, points) > 0.0)


def turns():
    """Every fifth surface that is drawn, on request all of them, with one method and device in turn."""
    devices = [info.name for info in usable_devices()]
    chosen = DRAWN if ALL else DRAWN[::5]
    return [(name, METHODS[i % 2], devices[i // 2 % len(devices)]) for i, name in enumerate(chosen) if devices]


@pytest.mark.one_in(2)
@pytest.mark.parametrize(("name", "method", "device_name"), turns())
def test_a_small_picture_is_as_the_oracle_says(name, method, device_name):
    """The oracle decides every ray; a method that claims no missed root misses none."""
    surface, device = surface_named(name), opened(device_name)
    if reason := unsupported(surface, "float32", device.language):
        pytest.skip(reason)
    rays = view_rays(surface, SIDE)
    truth = first_hits(surface, rays)
    assert (truth.status == TruthStatus.UNDECIDED).sum() == 0
    assert (truth.status == TruthStatus.CROSSING).mean() > 0.02
    verdicts = judge(cast(device, method, surface, "float32", rays), truth, scene_radius(surface), 1e-3, "float32")
    wrong = verdicts.wrong[verdicts.clear]
    if "no_missed_root" in find_methods().get(method).method.claims:
        assert not (wrong == Wrong.MISS).any()
    assert (wrong == Wrong.RIGHT).mean() > 0.9


def test_chebyshev_polynomials_are_those_of_cosines():
    angles = np.linspace(0.1, 3.0, 9)
    for degree in (2, 3, 7, 12, 20):
        at = np.stack([np.cos(angles), 0 * angles, 0 * angles], axis=1)
        for text, error in ((chebyshev(degree, "x"), 1e-6), (doubled(degree, "x"), 1e-13)):
            tape = lowering.real_tape(formula.parse(text))
            np.testing.assert_allclose(evaluate_tape(tape, at)[:, 0], np.cos(degree * angles), atol=error)


def test_boys_surface_is_the_image_of_aperys_parameters_and_in_its_domain():
    """F. Apéry, Models of the Real Projective Plane, 1987; at (0, 0, 2/3), three sheets meet."""
    surface = surfaces.get("boy")
    u, v = np.meshgrid(np.linspace(-np.pi / 2, np.pi / 2, 201), np.linspace(0.0, np.pi, 201))
    scale = np.cos(v) / (np.sqrt(2.0) - np.sin(3.0 * u) * np.sin(2.0 * v)) * 2.0 / 3.0
    x = scale * (np.cos(v) * np.cos(2.0 * u) + np.sqrt(2.0) * np.sin(v) * np.cos(u))
    y = scale * (np.cos(v) * np.sin(2.0 * u) - np.sqrt(2.0) * np.sin(v) * np.sin(u))
    points = np.stack((x, y, 1.5 * np.sqrt(2.0) * scale * np.cos(v)), axis=-1).reshape(-1, 3)
    assert np.allclose(surfaces.evaluate(surface, points), 0.0, atol=1e-10)
    assert np.linalg.norm(points - surface.domain.center, axis=1).max() < surface.domain.radius
    on_axis = np.array([[0.0, 0.0, 2.0 / 3.0 + h] for h in (1e-3, 2e-3)])
    values = surfaces.evaluate(surface, on_axis)
    assert values[1] / values[0] == pytest.approx(8.0, rel=0.01)


def test_folding_polynomials_multiply_angles():
    a, b = np.random.default_rng(1).uniform(-3.0, 3.0, (2, 20))

    def orbit(n):
        return np.exp(1j * n * a) + np.exp(1j * n * b) + np.exp(-1j * n * (a + b))

    at = np.stack([orbit(1).real, orbit(1).imag, 0 * a], axis=1)
    for degree in (2, 3, 6, 8, 9, 12):
        real, imaginary = (evaluate_tape(lowering.real_tape(formula.parse(text)), at)[:, 0] for text in folding(degree))
        np.testing.assert_allclose(real + 1j * imaginary, orbit(degree), atol=1e-7)
    with pytest.raises(ValueError, match="leaves 5"):
        folded(10)


def test_the_convolution_surface_is_the_integral_of_its_kernel():
    points = np.array([[0.3, 0.2, 0.1], [1.2, 0.1, 0.0], [-0.5, 0.7, 0.9]])
    on, total = np.linspace(-1.0, 1.0, 4001), np.full(3, -0.2)
    for axis in range(3):
        aside = np.sum(np.delete(points, axis, axis=1) ** 2, axis=1)
        kernel = 1.0 / (1.0 + 16.0 * (aside[:, None] + (points[:, axis, None] - on) ** 2)) ** 2
        total += np.trapezoid(kernel, on, axis=1)
    np.testing.assert_allclose(surfaces.evaluate(surfaces.get("convolution_jack"), points), total, rtol=1e-5)
