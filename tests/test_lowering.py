"""Lowering: tapes keep their meaning through every pass, cost what they should, and print as the same function."""

from __future__ import annotations

from fractions import Fraction

import flint
import numpy as np
import pytest
import sympy
from numpy.typing import NDArray

import surfaces
from harness.contract import Box, FirsthitError, Precision, Section, Surface
from harness.devices.interface import Device, map_rows
from harness.kernels import printing
from harness.kernels.assemble import map_program
from harness.kernels.functions import expands, libraries_for, surface_sections, unsupported
from surfaces import formula, lowering
from surfaces.evaluation import Floats, evaluate_tape, tape_of
from surfaces.numbers import BallPolynomials, Balls
from surfaces.tape import Builder, walk

CATALOG = [surfaces.get(name) for name in surfaces.names()]
EVERYTHING = surfaces.from_formula(
    "max(x*y, abs(z - 0.2), min(x, y)) + exp(x)/(2.5 + y) - log(3 + z)*sin(x*y) + cos(z)*tan(0.5*x) + sqrt(2 + x^2)^3",
    "sphere:1",
    "everything",
)
SUBJECTS = [*CATALOG, EVERYTHING]
each = pytest.mark.parametrize("surface", SUBJECTS, ids=lambda s: s.name)
Points = NDArray[np.float64]


def scattered(surface: Surface, count: int) -> Points:
    rng = np.random.default_rng(len(surface.formula))
    return rng.uniform(-0.6, 0.6, (count, 3)) * surface.domain.radius + surface.domain.center


@each
def test_value_and_derivatives_are_those_of_sympy(surface: Surface) -> None:
    expression, symbols = surfaces.expression(surface), (formula.X, formula.Y, formula.Z)
    points = scattered(surface, 5)
    gradient = [sympy.diff(expression, s) for s in symbols]
    wanted = np.array(
        [
            [
                float(sympy.N(g.subs(dict(zip(symbols, map(sympy.Float, p), strict=True))), 30))
                for g in (expression, *gradient)
            ]
            for p in points
        ]
    )
    scale = 1e-12 * (1.0 + np.abs(wanted).max())
    assert np.allclose(surfaces.evaluate(surface, points), wanted[:, 0], rtol=1e-12, atol=scale)
    assert np.allclose(surfaces.gradient(surface, points), wanted[:, 1:], rtol=1e-12, atol=scale)


@each
def test_hessian_product_is_the_gradient_s_slope(surface: Surface) -> None:
    points = scattered(surface, 50)
    direction = np.array([0.6, -0.48, 0.64])
    tape = lowering.hessian_product(lowering.real_tape(tape_of(surface)))
    variables = dict(zip("xyz", points.T, strict=True)) | dict(zip(("vx", "vy", "vz"), direction, strict=True))
    product = np.stack([np.broadcast_to(o, len(points)) for o in walk(tape, Floats(), variables)], axis=1)
    step = 1e-5 * surface.domain.radius
    slope = surfaces.gradient(surface, points + step * direction) - surfaces.gradient(
        surface, points - step * direction
    )
    scale = np.abs(product).max() + np.abs(surfaces.gradient(surface, points)).max() / surface.domain.radius
    assert np.allclose(product, slope / (2.0 * step), rtol=1e-5, atol=1e-6 * scale)


@each
def test_tangent_is_the_gradient_along(surface: Surface) -> None:
    points, direction = scattered(surface, 50), np.array([0.6, -0.48, 0.64])
    tape = lowering.tangent(lowering.real_tape(tape_of(surface)), {"x": "dx", "y": "dy", "z": "dz"})
    variables = dict(zip("xyz", points.T, strict=True)) | dict(zip(("dx", "dy", "dz"), direction, strict=True))
    value, rate = walk(tape, Floats(), variables)
    gradient = surfaces.gradient(surface, points)
    assert np.allclose(value, surfaces.evaluate(surface, points), rtol=1e-13)
    assert np.allclose(rate, gradient @ direction, rtol=1e-11, atol=1e-11 * np.abs(gradient).max())


@pytest.mark.parametrize("surface", [s for s in CATALOG if s.algebraic], ids=lambda s: s.name)
def test_coefficients_are_the_exact_expansion(surface: Surface) -> None:
    """Against flint's polynomials of balls, at any degree."""
    assert surface.degree is not None
    exact = lowering.coefficients_along(lowering.real_tape(tape_of(surface)), surface.degree)
    origin, direction = ("0.3", "-0.2", "0.45"), ("0.36", "0.48", "-0.8")
    rays = dict(zip(("ox", "oy", "oz", "dx", "dy", "dz"), origin + direction, strict=True))
    with flint.ctx.workprec(300):
        found = walk(exact, Balls(), {name: flint.arb(v) for name, v in rays.items()})
        lines = {
            a: flint.arb_poly([flint.arb(o), flint.arb(d)]) for a, o, d in zip("xyz", origin, direction, strict=True)
        }
        wanted = walk(tape_of(surface), BallPolynomials(), lines)[0]
        scale = max(float(abs(wanted[k]).upper()) for k in range(surface.degree + 1))
        assert len(found) == surface.degree + 1
        for k, coefficient in enumerate(found):
            assert abs(coefficient - wanted[k]) < 1e-60 * scale


@pytest.mark.parametrize(
    ("name", "value", "gradient"),
    [("sphere", 6, 3), ("torus", 9, 14), ("barth_sextic", 18, 34), ("sixteen_ball", 15, 21)],
)
def test_operation_counts(name: str, value: int, gradient: int) -> None:
    """Known to the operation: a pass that starts to waste work shows here."""
    surface = surfaces.get(name)
    assert sum(surfaces.operations(surface).values()) == value
    assert sum(lowering.counts(lowering.gradient(lowering.real_tape(tape_of(surface)))).values()) <= gradient


def test_subexpressions_are_shared_and_powers_squared() -> None:
    tape = lowering.real_tape(formula.parse("(x + y)^8 + (y + x)^3 + sin(x + y)"))
    assert lowering.counts(tape) == {"add": 3, "mul": 1, "sin": 1, "sqr": 3}


def test_written_order_is_kept() -> None:
    """z + y + x rounds differently from x + y + z: neither is turned into the other."""
    ops = lowering.real_tape(formula.parse("z + y + x")).ops
    assert [op.args[0] for op in ops if op.name == "var"] == ["z", "y", "x"]


def test_simplifications_keep_the_value() -> None:
    b = Builder()
    x = b.var("x")
    three = b.const(3)
    assert b.sub(x, x) == b.const(0) == b.mul(x, b.const(0))
    assert b.add(b.sub(x, three), b.const(5)) == b.add(x, b.const(2))
    assert b.sub(b.add(x, three), three) == x == b.neg(b.neg(x)) == b.mul(b.const(1), x)
    assert b.mul(three, b.mul(b.const(2), x)) == b.mul(b.const(6), x)
    assert b.sqr(b.neg(x)) == b.sqr(x) == b.mul(x, x) == b.mul(b.neg(x), b.neg(x))
    assert b.div(x, b.const(4)) == b.mul(b.const(Fraction(1, 4)), x)
    with pytest.raises(ZeroDivisionError):
        b.div(x, b.const(0))


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_literals_read_back_as_the_nearest_number(precision: Precision) -> None:
    kind = np.dtype(precision).type
    rng = np.random.default_rng(5)
    values = [
        Fraction(float(v)) * Fraction(10**6 + 3, 10**6)
        for v in rng.normal(size=300) * 10.0 ** rng.integers(-30, 30, 300)
    ]
    values += [
        Fraction(0),
        Fraction(1),
        Fraction(1, 3),
        Fraction(2**24 + 1),
        Fraction(-(2**53) - 1),
        Fraction(2**24 + 3),
    ]
    values.append(Fraction(1) + Fraction(1, 2**24) + Fraction(1, 2**80))  # a double rounding would lose it
    for value in values:
        number = printing.nearest(value, precision)
        neighbours = [number, np.nextafter(number, kind(np.inf)), np.nextafter(number, kind(-np.inf))]
        assert min(abs(Fraction(float(n)) - value) for n in neighbours) == abs(Fraction(float(number)) - value)
        for language, suffix in (("glsl", "lf"), ("cl", "")):
            text = printing.number(number, precision, language).strip("()")  # type: ignore[arg-type]
            ending = "f" if precision == "float32" else suffix
            assert text.endswith(ending) and kind(text.removesuffix(ending)) == number and "." in text
        lo, hi = printing.bounds(value, value, precision)
        assert Fraction(float(lo)) <= value <= Fraction(float(hi)) and hi in (lo, np.nextafter(lo, kind(np.inf)))


def test_constants_past_the_precision_are_refused() -> None:
    surface = surfaces.from_formula("1e60*x - y", "sphere:1")
    reason = unsupported(surface, "float32", "cl")
    assert reason is not None and "past the range of float32" in reason
    assert unsupported(surface, "float64", "cl") is None
    with pytest.raises(FirsthitError, match="past the range of float32"):
        surface_sections(surface, ("surface_value",), "float32", "cl")


def test_sections_hold_what_is_needed_and_nothing_else() -> None:
    torus, barth = surfaces.get("torus"), surfaces.get("barth_sextic")

    def names(surface: Surface, *needs: str) -> list[str]:
        return [s.origin.split(", ")[-1] for s in surface_sections(surface, needs, "float32", "glsl")]

    assert names(torus) == ["constants"]
    assert names(torus, "constants", "surface_value") == ["constants", "surface_value"]
    assert names(torus, "surface_value_along") == [
        "constants",
        "surface_coefficients_along",
        "surface_along",
        "surface_value_along",
    ]
    assert names(barth, "surface_value_along") == ["constants", "surface_value", "surface_along", "surface_value_along"]
    assert names(barth, "surface_dual_along") == ["constants", "surface_along", "surface_dual_along"]
    assert names(barth, "surface_range_along") == ["constants", "surface_range", "surface_range_along"]
    assert names(surfaces.get("blinn_blob"), "surface_range")[0].endswith("interval_exp_log.glsl")
    assert libraries_for(("surface_range_along", "surface_dual_along")) == ("interval", "dual")
    assert libraries_for(("surface_value",)) == ()


def test_what_a_surface_lacks_is_said() -> None:
    barth = surfaces.get("barth_sextic")
    for need, reason in (
        ("surface_distance", "has no distance function"),
        ("surface_coefficients_along", "of degree 6"),
        ("surface_volume", "no generated function"),
    ):
        with pytest.raises(FirsthitError, match=reason):
            surface_sections(barth, (need,), "float32", "cl")
    blob = surfaces.get("blinn_blob")
    assert unsupported(blob, "float64", "glsl") == "GLSL has no exp in float64"
    assert unsupported(blob, "float64", "cl") is None is unsupported(blob, "float32", "glsl")


PROBE = Section(
    "tests: every generated function over rows",
    """#define INPUTS 10
#define OUTPUTS 11
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    vec3 p = vec3(x[0], x[1], x[2]);
    vec3 v = vec3(x[3], x[4], x[5]);
    vec3 g = surface_gradient(p);
    vec3 h = surface_hessian_product(p, v);
    Along along = surface_along(make_ray(p, v));
    Dual dual = surface_dual_along(along, x[6]);
    y[0] = surface_value(p);
    y[1] = g.x; y[2] = g.y; y[3] = g.z;
    y[4] = h.x; y[5] = h.y; y[6] = h.z;
    y[7] = surface_value_along(along, x[6]);
    y[8] = dual.value;
    y[9] = dual.derivative;
    y[10] = BOUNDING_RADIUS + FEATURE_RADIUS + real(SURFACE_DEGREE) + dot(DOMAIN_CENTER, DOMAIN_UPPER - DOMAIN_LOWER);
}
""",
)
IN_FLOAT64 = ("torus", "barth_decic", "blinn_blob", "everything")
MAPPED = ("surface_value", "surface_gradient", "surface_hessian_product", "surface_value_along", "surface_dual_along")


@pytest.mark.parametrize(
    ("surface", "precision"),
    [(s, "float32") for s in SUBJECTS] + [(s, "float64") for s in SUBJECTS if s.name in IN_FLOAT64],
    ids=lambda v: getattr(v, "name", v),
)
def test_devices_compute_the_same_function(surface: Surface, device: Device, precision: Precision) -> None:
    if precision == "float64" and not device.info.float64:
        pytest.skip("no float64 here")
    if reason := unsupported(surface, precision, device.language):
        pytest.skip(reason)
    sections = surface_sections(surface, MAPPED, precision, device.language)
    program = map_program([*sections, PROBE], precision, device.language, libraries_for(MAPPED))
    points = scattered(surface, 300)
    direction = np.array([0.6, -0.48, 0.64])
    t = np.random.default_rng(2).uniform(-0.3, 0.3, 300) * surface.domain.radius
    rows = (
        np.column_stack([points, np.tile(direction, (300, 1)), t, np.zeros((300, 3))])
        .astype(precision)
        .astype(np.float64)
    )
    found = map_rows(device, program, rows, 11).astype(np.float64)

    points, direction, ends = rows[:, :3], rows[0, 3:6], rows[:, :3] + rows[:, 6:7] * rows[:, 3:6]
    tape = lowering.hessian_product(lowering.real_tape(tape_of(surface)))
    variables = dict(zip("xyz", points.T, strict=True)) | dict(zip(("vx", "vy", "vz"), direction, strict=True))
    product = np.stack([np.broadcast_to(o, 300) for o in walk(tape, Floats(), variables)], axis=1)
    along = surfaces.evaluate(surface, ends)
    radius, domain = surface.domain.radius, surface.domain
    lower, upper = (
        (np.array(domain.lower), np.array(domain.upper))
        if isinstance(domain, Box)
        else (-np.full(3, radius), np.full(3, radius))
    )
    constants = (surface.bounding_radius or radius) + (surface.feature_radius or radius) + (surface.degree or 0)
    constants += np.dot(domain.center, upper - lower)
    wanted = np.column_stack(
        [
            surfaces.evaluate(surface, points),
            surfaces.gradient(surface, points),
            product,
            along,
            along,
            surfaces.gradient(surface, ends) @ direction,
            np.full(300, constants),
        ]
    )
    unit = {"float32": 2.0**-24, "float64": 2.0**-53}[precision]
    assert np.all(np.abs(found - wanted) <= 100.0 * unit * (1.0 + np.abs(wanted).max(axis=0)))


@pytest.mark.parametrize("surface", [s for s in CATALOG if expands(s)], ids=lambda s: s.name)
def test_devices_expand_along_a_ray(surface: Surface, device: Device) -> None:
    assert surface.degree is not None
    count = surface.degree + 1
    item = Section(
        "tests: coefficients over rows",
        f"#define INPUTS 6\n#define OUTPUTS {count}\n"
        "void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {\n"
        "    surface_coefficients_along(make_ray(vec3(x[0], x[1], x[2]), vec3(x[3], x[4], x[5])), y);\n}\n",
    )
    sections = surface_sections(surface, ("surface_coefficients_along",), "float32", device.language)
    rays = np.random.default_rng(4).normal(size=(200, 6)).astype(np.float32)
    found = map_rows(device, map_program([*sections, item], "float32", device.language), rays, count)
    tape = lowering.coefficients_along(lowering.real_tape(tape_of(surface)), surface.degree)
    variables = dict(zip(("ox", "oy", "oz", "dx", "dy", "dz"), rays.astype(np.float64).T, strict=True))
    wanted = np.stack([np.broadcast_to(c, 200) for c in walk(tape, Floats(), variables)], axis=1)
    assert np.allclose(found, wanted, rtol=1e-5, atol=1e-6 * np.abs(wanted).max())


@pytest.mark.parametrize("surface", [s for s in CATALOG if s.distance], ids=lambda s: s.name)
def test_devices_compute_the_distance(surface: Surface, device: Device) -> None:
    item = Section(
        "tests: distance over rows",
        "#define INPUTS 3\n#define OUTPUTS 1\nvoid map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {\n"
        "    y[0] = surface_distance(vec3(x[0], x[1], x[2]));\n}\n",
    )
    sections = surface_sections(surface, ("surface_distance",), "float32", device.language)
    points = scattered(surface, 200).astype(np.float32).astype(np.float64)
    found = map_rows(device, map_program([*sections, item], "float32", device.language), points, 1)[:, 0]
    assert surface.distance is not None
    wanted = evaluate_tape(lowering.real_tape(formula.parse(surface.distance, dict(surface.parameters))), points)[:, 0]
    assert np.allclose(found, wanted, atol=1e-6 * surface.domain.radius)


def test_a_table_past_the_range_of_its_precision_is_refused() -> None:
    with pytest.raises(FirsthitError, match="table SIZES has a number past the range of float32; scale the formula"):
        printing.table("SIZES", [1.0, 1e39], "float32", "glsl")
    assert printing.table("SIZES", [1e39], "float64", "cl").startswith("TABLE real SIZES[1] = {")
