"""The bounds of fourth derivatives (harness/kernels/fourths.py), held against exact derivatives at random points."""

from __future__ import annotations

import flint
import numpy as np
import pytest

import surfaces
from harness.conformance import dense
from harness.contract import FirsthitError
from harness.kernels import fourths
from surfaces.lowering import real_tape
from surfaces.numbers import BallPolynomials
from surfaces.tape import walk

GRID, BEYOND, PARTS = 4, 0.5, 8  # of the small tables here
CATALOG = [name for name in surfaces.names() if surfaces.get(name).degree is not None]
GRID_NEAR = 8
EXACT = 4  # points of each table at which the derivative is computed exactly: those nearest to their bound


class Jets:
    """Run a tape in polynomials in t up to t^4, float64[5, …], by ordinary floats."""

    def const(self, value):
        return np.array([float(value), 0.0, 0.0, 0.0, 0.0])[:, None]

    def add(self, a, b):
        return a + b

    def sub(self, a, b):
        return a - b

    def neg(self, a):
        return -a

    def mul(self, a, b):
        return np.array([sum(a[i] * b[k - i] for i in range(k + 1)) for k in range(5)])

    def sqr(self, a):
        return self.mul(a, a)

    def div(self, a, b):
        return a / b[0]


def derivatives(surface, points, ways):
    """Return |D⁴f| along unit vectors `ways` at `points`, float64[n, 3] each."""
    still = np.zeros((3, len(points)))
    lines = {axis: np.array([points[:, k], ways[:, k], *still]) for k, axis in enumerate("xyz")}
    (jet,) = walk(real_tape(surfaces.tape_of(surface)), Jets(), lines)
    return np.broadcast_to(24.0 * np.abs(jet[4]), len(points))


def exact_derivative(surface, point, way):
    """Return a ball that holds |D⁴f(point)(way, way, way, way)| / |way|⁴."""
    with flint.ctx.workprec(300):
        lines = {axis: flint.arb_poly([float(p), float(v)]) for axis, p, v in zip("xyz", point, way, strict=True)}
        (along,) = walk(real_tape(surfaces.tape_of(surface)), BallPolynomials(), lines)
        length = sum(flint.arb(float(v)) ** 2 for v in way)
        return abs(flint.arb_poly(along)[4]) * 24 / length**2


def places(surface, table, count, rng, beyond=BEYOND):
    """Return random cells int[count, 3] of a table, points of each one's surroundings, and unit vectors."""
    grid, half = len(table), fourths.half_side(surface.domain)
    cells = rng.integers(0, grid, (count, 3))
    spots = rng.uniform(-0.5 - beyond, 0.5 + beyond, (count, 3))
    spots[::2] = np.sign(spots[::2]) * (0.5 + beyond)  # corners
    points = np.clip((cells + 0.5 + spots) * (2.0 / grid) - 1.0, -1.0, 1.0)
    ways = rng.normal(size=(count, 3))
    ways[::3] = np.sign(ways[::3]) * rng.integers(0, 2, (len(ways[::3]), 3))
    ways[~ways.any(axis=1), 0] = 1.0
    return cells, points * half + np.array(surface.domain.center), ways / np.linalg.norm(ways, axis=1)[:, None]


def allowed(table, cells, ways):
    """Return the bounds of |D⁴f| along unit vectors `ways` in cells, float64[n]."""
    powers = np.array([*fourths.POWERS, (0, 0, 0)])
    parts = np.prod(np.abs(ways)[:, None, :] ** powers, axis=-1)
    return (table[cells[:, 2], cells[:, 1], cells[:, 0]] * parts).sum(axis=1)


def most_exceeded(surface, table, seed, count=2000, beyond=BEYOND):
    """Return the largest share of its bound that a derivative is, of all by floats, and of the EXACT largest exactly.

    A share is certain where it is exact: its lower end is taken.
    """
    rng = np.random.default_rng(seed)
    cells, points, ways = places(surface, table, count, rng, beyond)
    bounds = allowed(table, cells, ways)
    found = derivatives(surface, points, ways)
    assert (found[bounds == 0.0] == 0.0).all()
    shares = np.divide(found, bounds, out=np.zeros(count), where=bounds > 0.0)
    worst = np.argsort(shares)[-EXACT:]
    exact = [float(exact_derivative(surface, points[i], ways[i]).lower()) / max(bounds[i], 1e-300) for i in worst]
    return float(shares.max()), max(exact)


def small_table(surface, monkeypatch):
    monkeypatch.setattr(fourths, "PARTS", PARTS)
    return fourths.fourth_bounds.__wrapped__(surface, GRID, BEYOND)


@pytest.mark.parametrize("name", CATALOG)
def test_no_fourth_derivative_exceeds_its_bound_on_the_catalog(name, monkeypatch):
    surface = surfaces.get(name)
    table = small_table(surface, monkeypatch)
    by_floats, exact = most_exceeded(surface, table, seed=1)
    assert by_floats <= 1.0 + 1e-9
    assert exact <= 1.0
    assert surface.degree >= 4 or not table.any()


@pytest.mark.parametrize("degree", [3, 4, 5, 6, 9, 13, 17, 20])
def test_no_fourth_derivative_exceeds_its_bound_on_dense_polynomials(degree, monkeypatch):
    surface = dense.surface_of(degree, 7)
    by_floats, exact = most_exceeded(surface, small_table(surface, monkeypatch), seed=degree)
    assert by_floats <= 1.0 + 1e-9
    assert exact <= 1.0


@pytest.mark.parametrize("name", ["flirt", "barth_sextic", "chmutov"])
def test_a_shrunk_bound_is_caught(name, monkeypatch):
    surface = surfaces.get(name)
    table = small_table(surface, monkeypatch)
    assert most_exceeded(surface, 0.5 * table, seed=1)[1] > 1.0


def test_entries_hold_beyond_their_cells_by_what_they_say(monkeypatch):
    surface = surfaces.get("sixteen_ball")
    monkeypatch.setattr(fourths, "PARTS", PARTS)
    near, far = (fourths.fourth_bounds.__wrapped__(surface, GRID, beyond) for beyond in (0.0, 1.0))
    assert most_exceeded(surface, far, seed=2, beyond=1.0)[1] <= 1.0
    assert most_exceeded(surface, near, seed=2, beyond=0.0)[1] <= 1.0
    assert most_exceeded(surface, near, seed=2, beyond=1.0)[1] > 1.0
    # each entry is the largest of the cells that it holds
    for k, j, i in np.ndindex(2, 2, 2):
        about = near[max(k - 1, 0) : k + 2, max(j - 1, 0) : j + 2, max(i - 1, 0) : i + 2]
        assert (far[k, j, i] == about.max(axis=(0, 1, 2))).all()


def test_the_cube_holds_the_domain_off_the_origin():
    loose = surfaces.from_formula("x^6 + y*z^3 - 2", "box:1,2,3:2,4,9")
    table = fourths.fourth_bounds(loose)
    assert fourths.half_side(loose.domain) == pytest.approx(3.0 * 1.125)
    assert most_exceeded(loose, table, seed=3, beyond=1.0)[1] <= 1.0
    # the largest is 360 x² for x up to 1.5 + 27/8, in the cells farthest along x
    along_x = table[..., fourths.POWERS.index((4, 0, 0))]
    assert 1.0 <= along_x.max() / (360.0 * 4.875**2) < 1.001
    assert np.unravel_index(along_x.argmax(), along_x.shape)[2] >= 30
    assert table[..., fourths.POWERS.index((0, 1, 3))].max() == pytest.approx(24.0, rel=1e-5)  # of y z³


def test_bounds_are_near_the_derivatives(monkeypatch):
    """In half of the cells the bound is below 2 times the largest derivative that is found along an axis."""
    monkeypatch.setattr(fourths, "PARTS", 2 * GRID_NEAR)
    rng = np.random.default_rng(5)
    for name in ("tangle", "barth_sextic", "endrass_octic", "sixteen_ball"):
        surface = surfaces.get(name)
        table = fourths.fourth_bounds.__wrapped__(surface, GRID_NEAR, 0.5)
        shares = np.zeros((*table.shape[:3], 3))
        for _ in range(4):
            cells, points, _ = places(surface, table, 12_000, rng)
            axes = rng.integers(0, 3, len(cells))
            ways = np.eye(3)[axes]
            found = derivatives(surface, points, ways) / allowed(table, cells, ways)
            np.maximum.at(shares, (*cells.T[::-1], axes), found)
        assert 1.0 <= 1.0 / np.median(shares) < 2.0


def test_a_bound_rounded_to_float32_is_one():
    table = fourths.fourth_bounds(surfaces.get("tangle"))  # x⁴ + y⁴ + z⁴ and lower terms
    rounded = table.astype(np.float32)
    for powers in np.eye(3, dtype=int) * 4:
        assert rounded[..., fourths.POWERS.index(tuple(powers))].min() > 24.0
    assert rounded[..., -1].max() == 0.0
    with pytest.raises(ValueError, match="read-only"):
        table[0, 0, 0] = 0.0


@pytest.mark.parametrize("nodes", [fourths.NODES, (-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0), (-0.9, -0.1, 0.2, 1.0)])
def test_what_is_said_of_interpolation_holds_and_is_near(nodes):
    error, lebesgue = fourths.interpolation(nodes)
    x = np.linspace(-1.0, 1.0, 20_001)
    product, sizes = np.ones_like(x), np.zeros_like(x)
    for k, node in enumerate(nodes):
        product *= x - node
        sizes += np.abs(np.prod([(x - other) / (node - other) for other in (*nodes[:k], *nodes[k + 1 :])], axis=0))
    assert 1.0 < error / (np.abs(product).max() / 24.0) < 1.00001
    assert 1.0 < lebesgue / sizes.max() < 1.00001


def test_what_has_no_bound_is_refused():
    with pytest.raises(FirsthitError, match="not algebraic"):
        fourths.fourth_bounds(surfaces.get("blinn_blob"))
    with pytest.raises(FirsthitError, match="multiple of 1/2"):
        fourths.fourth_bounds(surfaces.get("tangle"), 16, 0.3)
    huge = surfaces.from_formula("1e200*x^8 + y - 1", "sphere:1e20")
    with pytest.raises(FirsthitError, match="no finite bound"):
        fourths.fourth_bounds(huge)


def test_the_tables_of_a_pyramid_follow_each_other_from_the_finest_to_the_coarsest():
    surface = surfaces.get("barth_sextic")
    rows, first, finer = fourths.fourth_pyramid(surface), 0, None
    for table in range(fourths.TABLES):
        side = fourths.GRID >> table
        bounds = rows[first : first + side**3].reshape(side, side, side, 16)
        first += side**3
        if finer is not None:  # a coarser cell with its surroundings holds its finer cells with theirs
            children = finer.reshape(side, 2, side, 2, side, 2, 16).max(axis=(1, 3, 5))
            assert (bounds >= children).all() and (bounds < 100.0 * children.max(axis=(0, 1, 2))).all()
        finer = bounds
    assert first == len(rows)
