"""Lowering and printing of floor, real powers, angles, selections and roots at 0: values, derivatives, and refusals."""

from __future__ import annotations

import inspect
import sys
from fractions import Fraction

import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError, Language, Precision, Surface
from harness.devices.interface import Device, map_rows
from harness.kernels import functions
from harness.kernels.assemble import map_program
from harness.kernels.functions import libraries_for, surface_sections, too_long, unsupported
from harness.kernels.printing import IntervalPrinter, RealPrinter
from surfaces import lowering
from surfaces.evaluation import evaluate_tape, tape_of
from surfaces.proofs.slopes import jumps, steepest
from surfaces.tape import Builder
from tests.test_lowering import MAPPED, PROBE

BOX = "sqrt(max(abs(x)-0.5,0)^2+max(abs(y)-0.4,0)^2+max(abs(z)-0.3,0)^2)+min(max(abs(x)-0.5,abs(y)-0.4,abs(z)-0.3),0)"
FORMULAS = {
    "box": BOX,
    "twist": "(x*cos(2*atan2(y, x)) + z)^2 + y^2 - 0.5",
    "powers": "abs(x)^2.5 + abs(y)^2.3 + abs(z)^0.7 - 1",
    "parts": "if(x > 0.01, log(x) + sqrt(x) + y, x^2 + y^2 + z^2 - 1)",
    "lattice": "sqrt((mod(x, 0.5) - 0.25)^2 + y^2 + z^2) - 0.2",
}
SURFACES = [surfaces.from_formula(text, "sphere:1.5", name) for name, text in FORMULAS.items()]
each = pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)
SPECIAL = np.array(  # where roots, powers and angles have 0 as their argument, or -0
    [[0, 0, 0], [0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.5], [-0.5, 0, 0], [-0.5, -0.0, 0.1], [-0.0, 0, -0.2], [0.55, 0, 0]]
)


@each
def test_derivatives_are_those_of_differences(surface: Surface) -> None:
    points = np.random.default_rng(1).uniform(-0.8, 0.8, (200, 3))
    step = 1e-6
    slopes = []
    for axis in np.eye(3):
        ahead, back = (surfaces.evaluate(surface, points + sign * step * axis) for sign in (1, -1))
        slopes.append((ahead - back) / (2 * step))
    wrong = np.abs(surfaces.gradient(surface, points) - np.stack(slopes, axis=1)) > 1e-4
    assert wrong.any(axis=1).sum() <= 2  # points next to a kink or a jump


@each
def test_derivatives_are_numbers_where_a_root_is_of_0(surface: Surface) -> None:
    assert np.isfinite(surfaces.gradient(surface, SPECIAL)).all()
    if surface.name == "box":  # on a face inside of the other two slabs, f falls along the face's normal alone
        assert np.array_equal(
            surfaces.gradient(surface, np.array([[0.49, 0.1, 0.1], [0.1, 0.1, -0.5]])), [[1, 0, 0], [0, 0, -1]]
        )


@pytest.mark.parametrize("precision", ["float32", "float64"])
@each
def test_devices_compute_the_same_function(surface: Surface, device: Device, precision: Precision) -> None:
    if reason := unsupported(surface, precision, device.language):
        pytest.skip(reason)
    sections = surface_sections(surface, MAPPED, precision, device.language)
    program = map_program([*sections, PROBE], precision, device.language, libraries_for(MAPPED))
    points = np.vstack([SPECIAL, np.random.default_rng(3).uniform(-0.9, 0.9, (300, 3))])
    direction = np.tile([0.6, -0.48, 0.64], (len(points), 1))
    rows = np.hstack([points, direction, np.zeros((len(points), 4))]).astype(precision)
    found = map_rows(device, program, rows, 11).astype(np.float64)
    assert np.isfinite(found).all()
    points, direction = rows[:, :3].astype(np.float64), rows[:, 3:6].astype(np.float64)
    slopes = surfaces.gradient(surface, points)
    values = surfaces.evaluate(surface, points)
    wanted = np.column_stack([values, slopes, values, values, (slopes * direction).sum(axis=1)])
    errors = np.abs(found[:, [0, 1, 2, 3, 7, 8, 9]] - wanted) / (1.0 + np.abs(wanted))
    unit = {"float32": 2.0**-24, "float64": 2.0**-53}[precision]
    within = errors <= 400.0 * unit  # Mesa's atan alone is wrong by 30 units
    assert within.all(axis=1).mean() > 0.99, (found[~within.all(axis=1)][:3], wanted[~within.all(axis=1)][:3])
    assert within[: len(SPECIAL)].all()


@pytest.mark.parametrize(
    ("text", "name"),
    [("abs(x)^0.3 - y", "pow"), ("atan2(y, x) - z", "atan"), ("exp(x) - y", "exp"), ("if(x > 0, sin(y), z)", "sin")],
)
def test_glsl_refuses_by_name_what_it_lacks_in_float64(text: str, name: str) -> None:
    surface = surfaces.from_formula(text, "sphere:1.5")
    assert unsupported(surface, "float64", "glsl") == f"GLSL has no {name} in float64"
    assert unsupported(surface, "float64", "cl") is unsupported(surface, "float32", "glsl") is None


def test_glsl_has_floor_and_selections_in_float64() -> None:
    surface = surfaces.from_formula("if(x > 0, mod(y, 1), z)", "sphere:1.5")
    assert unsupported(surface, "float64", "glsl") is None


@pytest.mark.parametrize("language", ["glsl", "cl"])
def test_a_formula_written_in_another_way_gives_the_same_text(language: Language) -> None:
    forms = ("x^2 + y^2 + z^2 - 1", "pow(x, 2) + pow(y, 2) + pow(z, 2) - 1", "x^2 + y^2 + z^2 = 1")
    for needs in (["surface_value", "surface_gradient", "surface_dual_along"], ["surface_range"]):
        made = [surface_sections(surfaces.from_formula(f, name="s"), needs, "float32", language) for f in forms]
        assert made[0] == made[1] == made[2]


def long_tape(count: int) -> lowering.Tape:
    """Make a tape of a chain of `count` operations, each of which needs the one before."""
    b = Builder()
    value, x, y = b.var("x"), b.var("x"), b.var("y")
    for k in range(count // 2):
        value = b.min(b.sqrt(b.add(b.sqr(value), y)), b.mul(x, value)) if k % 5 == 0 else b.sub(b.mul(value, y), x)
    return b.tape(value)


def test_long_tapes_are_lowered_and_printed_without_recursion() -> None:
    tape = long_tape(6_000)
    assert len(tape.ops) > 6_000
    deep = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack()) + 40)
    try:
        real = lowering.real_tape(tape)
        variables = {name: name for name in ("x", "y", "z", "dx", "dy", "dz")}
        for made in (real, lowering.gradient(real), lowering.tangent(real, {"x": "dx", "y": "dy"})):
            lines, _ = RealPrinter(variables, "float32", "cl").body(made)
            assert len(lines) >= 6_000
        lines, _ = IntervalPrinter(variables, "float32", "cl").body(tape)
        assert len(lines) >= 6_000
    finally:
        sys.setrecursionlimit(deep)


def test_what_no_compiler_takes_is_refused_with_its_operation_count() -> None:
    parts = ", ".join(f"sqrt((x - {k}/400)^2 + y^2 + z^2) - 0.1" for k in range(400))
    surface = surfaces.from_formula(f"min({parts})", "sphere:1.5", "beads")
    values, ranges = ("surface_value",), ("surface_range",)
    assert too_long(surface, values, "float32", "cl") is None is too_long(surface, values, "float32", "glsl")
    reason = too_long(surface, ranges, "float32", "glsl")
    most = functions.MOST_OPERATIONS["glsl"]["interval"]
    assert reason is not None
    assert "operations on intervals" in reason and f"more than {most:,} in 20 s" in reason
    with pytest.raises(FirsthitError, match=r"^beads: its functions have 2,800 operations on intervals"):
        surface_sections(surface, ranges, "float32", "glsl")


def test_a_slope_is_bounded_through_cone_points_kinks_and_smooth_minima() -> None:
    import flint

    everywhere = {axis: flint.arb(0, 1.5) for axis in "xyz"}
    bounded = {
        "sqrt(x^2 + y^2 + z^2) - 1": 1.0,
        "sqrt((sqrt(x^2 + y^2) - 0.8)^2 + z^2) - 0.3": 1.0,
        "sqrt(2*x^2 + y^2) - 1": 2.0**0.5,
        "sqrt(max(abs(x) - 0.5, 0)^2 + max(abs(y) - 0.4, 0)^2 + max(abs(z), 0)^2) - 0.1": 1.0,
        "min(sqrt(x^2 + y^2 + z^2) - 1, max(x, y))": 1.0,
        "-log(exp(-8*(sqrt(x^2 + y^2 + z^2) - 0.5)) + exp(-8*(sqrt((x - 1)^2 + y^2 + z^2) - 0.5)))/8": 1.0,
        "abs(x)^1.5": 1.5 * 1.5**0.5,
        "abs(x)^2.5": 2.5 * 1.5**1.5,
    }
    for text, slope in bounded.items():
        tape = lowering.real_tape(tape_of(surfaces.from_formula(text, "sphere:1.5")))
        assert slope * (1 - 1e-9) <= steepest(tape, everywhere) <= slope * 1.0001, text
    rng = np.random.default_rng(2)
    for surface in (s for s in SURFACES if not jumps(tape_of(s)) and s.name != "powers"):
        tape = lowering.real_tape(tape_of(surface))
        for middle in rng.uniform(-1, 1, (20, 3)):
            half = 10.0 ** rng.uniform(-3, -0.5)
            bound = steepest(tape, {axis: flint.arb(float(m), half) for axis, m in zip("xyz", middle, strict=True)})
            points = middle + rng.uniform(-half, half, (50, 3))
            assert np.linalg.norm(evaluate_tape(lowering.gradient(tape), points), axis=1).max() <= bound


def test_a_slope_of_what_jumps_is_refused() -> None:
    import flint

    tape = tape_of(surfaces.from_formula("floor(x) + y", "sphere:1.5"))
    assert jumps(tape) == ["floor"]
    with pytest.raises(ValueError, match="floor"):
        steepest(tape, {axis: flint.arb(0, 1) for axis in "xyz"})
    assert jumps(tape_of(surfaces.from_formula("max(x, floor(2.5))", "sphere:5"))) == []


def test_powers_that_are_not_whole_keep_their_exponent() -> None:
    b = Builder()
    tape = b.tape(b.powr(b.abs(b.var("x")), Fraction(7, 3)))
    assert np.allclose(evaluate_tape(tape, np.array([[8.0, 0, 0], [0, 0, 0]]))[:, 0], [128.0, 0.0])
    slope = evaluate_tape(lowering.gradient(tape), np.array([[-8.0, 0, 0], [0, 0, 0]]))
    assert np.allclose(slope[:, 0], [-7 / 3 * 16.0, 0.0])


def test_a_root_of_0_at_the_domain_s_end_is_0_although_rounding_is_under_0(device: Device) -> None:
    """A ray's point at the face x = 0 of the domain may have x = -1e-8; a sum of squares needs no care."""
    surface = surfaces.from_formula("x^(1/2) - y + sqrt((1 - y)*(1 + y)) + sqrt(x^2 + z^2)", "box:0,-1,-1:2,1,1")
    sections = surface_sections(surface, MAPPED, "float32", device.language)
    assert sections[1].text.count("sqrt(max(") == 2 and sections[1].text.count("sqrt(") == 3
    program = map_program([*sections, PROBE], "float32", device.language, libraries_for(MAPPED))
    rows = np.array([[-1e-8, 0, 0, 1, 0, 0, 0, 0, 0, 0], [1, 1.0000001, 0, 1, 0, 0, 0, 0, 0, 0]], np.float32)
    found = map_rows(device, program, rows, 11)
    assert np.isfinite(found).all() and np.allclose(found[:, 0], [1, 1], atol=1e-6)
