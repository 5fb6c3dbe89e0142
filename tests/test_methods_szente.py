"""szente's methods: the fit, the LU bound and what each knob is for; broken copies of each are caught."""

from __future__ import annotations

import dataclasses
import math
from fractions import Fraction
from functools import cache
from typing import Any

import flint
import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import NAMES, judge
from harness.contract import Precision, RayStatus, Section, Surface, TruthStatus, View
from harness.devices.interface import Device, hits_from, launch_rays, map_rows
from harness.kernels.assemble import map_program, method_program
from harness.kernels.fitting import fit_tables, inverse, nodes
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of, scene_radius

from .conftest import opened, usable_devices

VIEW = View("oblique", azimuth=30, elevation=35)
LU = ("interval", "dual", "polynomial", "lu")
LU_ITEM = """#define INPUTS (DEGREE + 1)
#define OUTPUTS 1
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    real b[COEFFICIENTS];
    for (int j = 0; j <= DEGREE; j++) b[j] = x[j];
    y[0] = lower_bound(lu_curve(b, DEGREE), DEGREE);
}
"""
DOT_ITEM = """#define INPUTS 60
#define OUTPUTS 1
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    Pair sum = make_pair(0.0, 0.0);
    for (int i = 0; i < 20; i++) sum = plus_product(sum, x[i], x[20 + i], make_factor(make_pair(x[40 + i], 0.0)));
    y[0] = sum.hi + sum.lo;
}
"""


@cache
def _case(name: str, size: int = 48) -> tuple[Surface, Any, Any]:
    surface = surfaces.get(name)
    rays = rays_of(camera_for(VIEW, surface), size)
    return surface, rays, first_hits(surface, rays)


def _cast(device: Device, method: str, surface: Surface, rays: Any, precision: Precision = "float32", **knobs: float):
    plugin = find_methods().get(method)
    program = method_program(
        plugin.method, plugin.folder, plugin.variant(knobs), surface, precision, device.language, "rays"
    )
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return hits


def _score(device: Device, method: str, name: str, size: int = 48, **knobs: float) -> tuple[float, float]:
    """Share of wrong answers outside the grazing class, and the 99th percentile of the others' relative error."""
    surface, rays, truth = _case(name, size)
    radius = scene_radius(surface)
    verdicts = judge(_cast(device, method, surface, rays, **knobs), truth, radius, 1e-3)
    clear = ~verdicts.grazing
    error = verdicts.error[clear & np.isfinite(verdicts.error)] / radius
    return float(np.isin(verdicts.wrong[clear], list(NAMES)).mean()), float(np.quantile(error, 0.99))


def _fast() -> Device:
    names = [info.name for info in usable_devices()]
    return opened("opencl:intel" if "opencl:intel" in names else names[0])


# The fit


@pytest.mark.parametrize("basis", ["monomial", "bernstein"])
@pytest.mark.parametrize("degree", [1, 2, 5, 8, 20])
def test_tables_give_a_polynomials_coefficients_back_from_its_samples(basis, degree, rng):
    tables = {name: [Fraction(v) for v in values] for name, values in fit_tables(degree, basis, "float32").items()}
    wanted = [Fraction(int(v)) for v in rng.integers(-9, 10, degree + 1)]
    if basis == "monomial":
        samples = [sum(c * x**j for j, c in enumerate(wanted)) for x in nodes(degree, "float32")]
    else:
        ys = [(1 + x) / 2 for x in nodes(degree, "float32")]
        samples = [
            sum(math.comb(degree, j) * c * y**j * (1 - y) ** (degree - j) for j, c in enumerate(wanted)) for y in ys
        ]
    n, evens, odds = degree, degree // 2 + 1, (degree + 1) // 2
    sums = [samples[n - i] + samples[i] if 2 * i != n else samples[i] for i in range(evens)]
    differences = [samples[n - i] - samples[i] for i in range(odds)]

    def rows(name: str, count: int, factors: list[Fraction]) -> list[Fraction]:
        matrix = [hi + lo for hi, lo in zip(tables[f"{name}_HI"], tables[f"{name}_LO"], strict=True)]
        return [sum(matrix[r * count + i] * factors[i] for i in range(count)) for r in range(count)]

    even, odd = rows("EVEN", evens, sums), rows("ODD", odds, differences)
    if basis == "monomial":
        found = [even[j // 2] if j % 2 == 0 else odd[j // 2] for j in range(n + 1)]
    else:
        odd += [Fraction(0)] * (evens - odds)
        found = [even[j] - odd[j] if 2 * j <= n else even[n - j] + odd[n - j] for j in range(n + 1)]
    norm = max(sum(abs(v) for v in row) for row in inverse(degree, basis, "float32"))
    size = max(abs(s) for s in samples)
    assert all(abs(a - b) <= 2.0**-46 * norm * size for a, b in zip(found, wanted, strict=True))


@pytest.mark.parametrize(
    ("basis", "printed"), [("monomial", (6.70, 36.94, 2882.20)), ("bernstein", (4.32, 16.56, 510.28))]
)
def test_condition_numbers_are_those_of_table_1(basis, printed):
    found = [np.linalg.cond(np.array(inverse(n, basis, "float64"), dtype=float)) for n in (3, 5, 10)]
    assert [round(float(v), 2) for v in found] == list(printed)


def _dot_errors(device: Device, precise: bool, rng: np.random.Generator) -> Any:
    """Errors of a 20-term compensated dot product, over u |sum| + u^2 sum |terms|, for sums that cancel."""
    rows = rng.uniform(-1, 1, (400, 60)).astype(np.float32)
    rows[:, 20:40] *= 2.0**-24
    exact = [
        sum((Fraction(float(r[i])) + Fraction(float(r[20 + i]))) * Fraction(float(r[40 + i])) for i in range(19))
        for r in rows
    ]
    rows[:, 59] = [float(-e) for e in exact]
    rows[:, 19], rows[:, 39] = 1.0, 0.0
    program = map_program(Section("tests: dot", DOT_ITEM), "float32", device.language, ("fit",))
    if not precise:
        blunt = tuple(dataclasses.replace(s, text=s.text.replace("PRECISE real", "real")) for s in program.sections)
        program = dataclasses.replace(program, sections=blunt)
    found = map_rows(device, program, rows, 1)[:, 0]
    errors = []
    for row, start, value in zip(rows, exact, found, strict=True):
        whole = start + Fraction(float(row[59]))
        terms = float(np.abs(row[:20].astype(float) * row[40:]).sum())
        errors.append(abs(float(value) - float(whole)) / (2.0**-24 * abs(float(whole)) + 2.0**-48 * terms))
    return np.array(errors)


def test_the_compensated_product_is_as_good_as_twice_the_precision(device, rng):
    assert _dot_errors(device, True, rng).max() < 40.0


def test_error_free_transforms_without_precise_are_caught(rng):
    names = [info.name for info in usable_devices() if info.name.startswith("opengl")]
    if not names:
        pytest.skip("only GLSL compilers may reorder what is not precise")
    assert _dot_errors(opened(names[0]), False, rng).max() > 1e4


# The LU bound


def _polynomials(degree: int, count: int, rng: np.random.Generator) -> Any:
    """float32[count, degree + 1], by turns: uniform; signed; unlike ends above equal others; the first the least."""
    b = rng.uniform(0, 1, (count, degree + 1))
    kind = np.arange(count) % 4
    b[kind == 1] = 2 * b[kind == 1] - 1
    b[kind == 2, 1:degree] = 0.0
    b[kind == 2, 0] = 10.0 ** rng.uniform(-6, -2, (kind == 2).sum())
    b[kind == 3, 0] = b[kind == 3].min(axis=1)
    return b.astype(np.float32)


def _lower(device: Device, rows: Any, slip: bool = False) -> Any:
    degree = rows.shape[1] - 1
    item = Section("tests: LU", f"#define DEGREE {degree}\n{LU_ITEM}")
    program = map_program(item, "float32", device.language, LU)
    if slip:
        text = program.text
        broken = tuple(
            dataclasses.replace(
                s, text=s.text.replace("degree - 1);\n        curve.low", "degree);\n        curve.low")
            )
            for s in program.sections
        )
        program = dataclasses.replace(program, sections=broken)
        assert program.text != text
    return map_rows(device, program, rows, 1)[:, 0].astype(np.float64)


def _certified_least(rows: Any) -> Any:
    """A proved lower bound of the LU function's least value, and so of the polynomial's, in float64.

    Convex: nowhere below its tangent at any point. Rounding errs by less than 1e-13 of the coefficients' size.
    """
    b, n = rows.astype(np.float64), rows.shape[1] - 1
    m = b.min(axis=1)
    p, q = b[:, 0] - m, b[:, -1] - m
    with np.errstate(divide="ignore", invalid="ignore"):
        x = np.where(p > 0, 1 / (1 + (q / p) ** (1 / (n - 1))), 0.0)
    value = m + p * (1 - x) ** n + q * x**n
    slope = n * (q * x ** (n - 1) - p * (1 - x) ** (n - 1))
    return value - np.maximum(slope * x, -slope * (1 - x)).clip(0) - 1e-13 * np.abs(b).max(axis=1)


def _sampled_least(rows: Any) -> Any:
    """An upper bound of the polynomials' least values: the least of 65 values, by de Casteljau in float64."""
    least = np.full(len(rows), np.inf)
    for x in np.linspace(0, 1, 65):
        b = rows.astype(np.float64)
        while b.shape[1] > 1:
            b = b[:, :-1] * (1 - x) + b[:, 1:] * x
        least = np.minimum(least, b[:, 0])
    return least


DEGREES = (2, 3, 4, 5, 7, 9, 12, 15, 17, 20)


@pytest.mark.parametrize("degree", DEGREES)
def test_the_lu_bound_holds_and_is_tight(degree, rng):
    rows = _polynomials(degree, 1_000_000 // len(DEGREES), rng)
    bound, certified = _lower(_fast(), rows), _certified_least(rows)
    assert (bound <= certified).all()  # conservative_bound
    assert (bound[:8000] <= _sampled_least(rows[:8000])).all()
    size = np.abs(rows).max(axis=1)
    assert (certified - bound <= 2e-5 * size).all()
    assert (bound >= rows.min(axis=1) - 2e-5 * size).all()


@pytest.mark.parametrize("degree", (2, 5, 20))
def test_the_lu_bound_holds_in_ball_arithmetic(degree, device, rng):
    rows = _polynomials(degree, 200, rng)
    x, unit = flint.fmpq_poly([0, 1]), flint.arb(0.5, 0.5)
    for row, bound in zip(rows, _lower(device, rows), strict=True):
        above = flint.fmpq_poly([0])
        for j, c in enumerate(Fraction(float(c)) - Fraction(float(bound)) for c in row):
            above += math.comb(degree, j) * flint.fmpq(c.numerator, c.denominator) * x**j * (1 - x) ** (degree - j)
        assert above(flint.fmpq(1, 2)) > 0
        roots = [root for root, _ in above.numer().complex_roots()]
        assert not [root for root in roots if root.imag.contains(0) and root.real.overlaps(unit)]


@pytest.mark.parametrize("degree", (2, 3, 5, 9))
def test_the_exponent_1_over_n_is_caught(degree, rng):
    rows = _polynomials(degree, 20000, rng)
    slipped = _lower(_fast(), rows, slip=True)
    assert (slipped > _certified_least(rows))[2::4].mean() > 0.4
    if degree == 2:
        assert (slipped > _sampled_least(rows)).any()  # not even below the polynomial: there the LU function equals it


# The methods


@pytest.mark.parametrize("name", ["endrass_octic", "barth_decic"])
@pytest.mark.parametrize("basis", [0, 1])
def test_eft_and_direct_evaluation_render_the_octic_and_the_decic(device, name, basis):
    wrong, error = _score(device, "eft_yuksel", name, BASIS=basis)
    assert wrong == 0.0
    assert error < 2e-6


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", ["endrass_octic", "barth_decic", "sixteen_ball"])
def test_without_eft_there_are_artifacts_that_eft_mends(name):
    plain = _score(_fast(), "eft_yuksel", name, 96, BASIS=1, EFT=0, EVAL=0)
    compensated = _score(_fast(), "eft_yuksel", name, 96, BASIS=1, EFT=1, EVAL=0)
    direct = _score(_fast(), "eft_yuksel", name, 96, BASIS=1, EFT=1, EVAL=1)
    assert plain[0] > 0.002 > 3 * compensated[0]
    assert plain[1] > 4 * compensated[1] > 40 * direct[1]


@pytest.mark.one_in(3)
@pytest.mark.parametrize("method", ["eft_yuksel", "lu_lipschitz"])
@pytest.mark.parametrize("formula", ["x + 2*y - z - 0.1", "x^3 + y^2*z - 0.2", "x^20 + y^20 + z^20 - 1"])
def test_degrees_from_1_to_20(method, formula):
    surface = surfaces.from_formula(formula, "sphere:1.5", "mine")
    rays = rays_of(camera_for(VIEW, surface), 24)
    truth = first_hits(surface, rays)
    for basis in (0, 1):
        knobs = {"BASIS": basis} if method == "eft_yuksel" else {"BOUND": basis}
        verdicts = judge(_cast(_fast(), method, surface, rays, **knobs), truth, scene_radius(surface), 1e-3)
        assert (truth.status == TruthStatus.CROSSING).sum() > 100
        assert not verdicts.wrong[~verdicts.grazing].any()


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", ["flirt", "calyx", "barth_sextic"])
@pytest.mark.parametrize("bound", [0, 1])
@pytest.mark.parametrize("local", [0, 1, 2])
def test_every_way_of_bounding_gives_the_same_picture(name, bound, local):
    for cull in (0, 1):
        wrong, error = _score(_fast(), "lu_lipschitz", name, BOUND=bound, LOCAL=local, CULL=cull)
        assert wrong <= 0.002
        assert error < 1e-5


def test_bounds_that_follow_the_ray_take_fewer_evaluations_and_lu_no_more_than_control_points(device):
    surface, rays, _ = _case("barth_sextic")
    spent = {
        (bound, local): _cast(device, "lu_lipschitz", surface, rays, BOUND=bound, LOCAL=local).evaluations.mean()
        for bound in (0, 1)
        for local in (0, 1, 2)
    }
    assert spent[1, 1] < 0.25 * spent[1, 0]
    assert spent[1, 1] < spent[1, 2] < spent[1, 0] < spent[0, 0]


def test_a_spent_budget_is_exhausted_and_never_a_miss(device):
    surface, rays, truth = _case("barth_sextic")
    status = _cast(device, "lu_lipschitz", surface, rays, MAX_EVALUATIONS=9).status
    hit = truth.status == TruthStatus.CROSSING
    assert (status[hit] == RayStatus.EXHAUSTED).mean() > 0.3
    assert (status[hit] == RayStatus.MISS).mean() < 0.01


@pytest.mark.parametrize("method", ["eft_yuksel", "yuksel"])
def test_a_smaller_tolerance_gives_a_smaller_error(method):
    coarse, fine = (_score(_fast(), method, "torus", TOLERANCE=t)[1] for t in (0.03, 1e-5))
    assert coarse > 10 * fine


@pytest.mark.parametrize("name", ["kummer", "cayley", "spindle_torus", "flirt"])
def test_exact_coefficients_give_the_first_root(device, name):
    wrong, error = _score(device, "yuksel", name)
    assert wrong == 0.0
    assert error < 5e-6


@pytest.mark.parametrize("method", ["eft_yuksel", "lu_lipschitz", "yuksel"])
def test_refusals_say_why(method):
    accepts = find_methods().get(method).method.accepts
    assert "not algebraic" in accepts(surfaces.get("blinn_blob"))
    assert "degree 21" in accepts(surfaces.from_formula("x^21 - y", "sphere:1", "mine"))
    assert accepts(surfaces.get("torus")) is None
