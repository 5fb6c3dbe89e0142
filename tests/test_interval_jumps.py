"""Interval extensions with floor, real powers, angles and selections hold f's exact values, and no jump is a root.

The exact values are flint's balls. FIRSTHIT_BOXES sets the boxes per formula and device.
"""

from __future__ import annotations

import os

import flint
import numpy as np
import pytest

import surfaces
from harness.contract import Precision, Section, Surface
from harness.devices.interface import Device, map_rows
from harness.kernels.functions import surface_sections
from tests.test_interval_containment import RANGE, drawn_boxes, exact_points, outside, program, usable

BOXES = int(os.environ.get("FIRSTHIT_BOXES", "1500"))
FORMULAS = {
    "floors": "floor(3*x) + x*floor(7*y + 0.3) - z",
    "small_steps": "floor(10000*x)/10 + z*floor(1000*y)",
    "lattice": "sqrt((mod(x, 0.5) - 0.25)^2 + (mod(y + 0.3, 0.5) - 0.25)^2 + z^2) - 0.2",
    "angles": "atan2(y, x) + 0.1*atan2(x^2, z) - z",
    "half_planes": "atan2(x^2 + 0.1, y) - atan2(z, 2) + atan2(0.0001*x, y - 0.5)",
    "roots": "abs(x)^0.34 - abs(z)^1.1 + abs(y)^2.3",
    "steep_powers": "(3 + x)^20.3/1000000000 - y + (0.0001 + abs(z))^7.77",
    "parts": "if(x > 0, x^2 + y, if(y <= z, 2 + z, 3*z))",
    "both": "if(x < y and z > 0.3, x + 3, sqrt(2.5 - y) + z)",
    "signs": "sign(x)*y + sign(y - 0.1) - 2*z",
}
SURFACES = [surfaces.from_formula(text, "sphere:1.5", name) for name, text in FORMULAS.items()]
each = pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)


def without_zero(lo: float, hi: float) -> bool:
    return lo > 0.0 or hi < 0.0


@pytest.mark.parametrize("precision", ["float32", "float64"])
@each
def test_a_range_holds_the_value_or_says_rightly_that_it_is_not_zero(
    surface: Surface, device: Device, precision: Precision
) -> None:
    usable(surface, device, precision)
    kind = np.dtype(precision).type
    count = BOXES if precision == "float32" else BOXES // 3
    boxes, points = drawn_boxes(surface, count, kind, np.random.default_rng(len(surface.formula)))
    built = program(surface, RANGE, precision, device.language, "surface_range")
    results = map_rows(device, built, boxes.reshape(-1, 6), 2).astype(np.float64)
    assert not np.isnan(results).any()
    balls = exact_points([[float(c) for c in p] for p in points], surfaces.tape_of(surface))
    for ball, (lo, hi), box in zip(balls, results, boxes, strict=True):
        # where f jumps in the box, the range may be that of one side, but then f is 0 on neither
        assert not outside(ball, lo, hi) or (without_zero(lo, hi) and not ball.contains(0)), (box, lo, hi, ball)
    narrow = (boxes[..., 1] - boxes[..., 0]).max(axis=1) == 0
    widths = (results[:, 1] - results[:, 0])[narrow]
    assert np.median(widths) < {"float32": 2e-3, "float64": 1e-11}[precision]  # at points it decides


BORDERS = {  # f jumps where x = 0.5, or its parts do, and has no root near the box about (0.5, 0.1, 0.2)
    "x - floor(x + 0.5) + y": False,  # from 0.6 to -0.4
    "(mod(x, 0.5) - 0.25)^2 + y - 0.1": False,  # it does not jump, but its parts do
    "if(x <= 0.5, 1, -1)": False,
    "if(x <= 0.5, x - 0.5, -1)": True,  # the root is on the border, and belongs to the left
    "floor(x + 0.5) - 1 + 0*y": True,  # 0 from the border on
    "atan2(y - 0.1, x - 2) + z": False,  # from pi to -pi across y = 0.1
    "mod(x, 0.5)": True,  # 0 on the border itself
    "sign(x - 0.5)": True,  # 0 on the border, between -1 and 1
    "2*sign(x - 0.5) + 1": False,  # -1, 1 and 3
    "(mod(x, 0.5) - 0.25)^2 + (mod(y + 0.4, 0.5) - 0.25)^2 - 0.01": False,  # an edge where four cells meet
}


@pytest.mark.parametrize(("text", "root"), BORDERS.items(), ids=lambda v: str(v))
def test_a_jump_in_a_small_box_is_a_root_only_where_there_is_one(device: Device, text: str, root: bool) -> None:
    surface = surfaces.from_formula(text, "sphere:1.5")
    built = program(surface, RANGE, "float32", device.language, "surface_range")
    middle, half = np.array([0.5, 0.1, 0.2]), 1e-5
    rows = np.stack([middle - half, middle + half], axis=1).reshape(1, 6)
    lo, hi = map_rows(device, built, rows.astype(np.float32), 2)[0]
    assert without_zero(lo, hi) != root, (lo, hi)


def test_one_sided_ranges_are_needed() -> None:
    """The same formulas without jumps keep one range, and their text as it was."""
    plain = surfaces.from_formula("x^2 + y^2 + z^2 - 1", "sphere:1.5")
    text = surface_sections(plain, ("surface_range",), "float32", "glsl")[-1].text
    assert "side" not in text
    assert "range_of_sides" in surface_sections(SURFACES[0], ("surface_range",), "float32", "glsl")[-1].text


ANGLES = Section(
    "tests: angles over rows",
    """#define INPUTS 2
#define OUTPUTS 2
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    Interval a = interval_atan2(make_interval(x[0], x[0]), make_interval(x[1], x[1]));
    y[0] = a.lo;
    y[1] = a.hi;
}
""",
)


def test_angles_of_points_near_axes_and_of_all_sizes(device: Device) -> None:
    """Ends and signs of zero are right: (0, 0) has the angle 0, the cut itself pi."""
    surface = surfaces.from_formula("atan2(y, x) - z", "sphere:1.5")
    rng = np.random.default_rng(5)
    sizes = rng.normal(size=(400, 2)) * 10.0 ** rng.uniform(-30, 30, (400, 2))
    exact = [(0.0, 0.0), (0.0, -1.0), (-0.0, -1.0), (0.0, 1.0), (1.0, 0.0), (-1.0, 0.0), (1.0, -0.0), (3e38, -3e38)]
    rows = np.array([*exact, *sizes.tolist()]).astype(np.float32)
    results = map_rows(device, program(surface, ANGLES, "float32", device.language, "surface_range"), rows, 2)
    with flint.ctx.workprec(200):
        for (a, b), (lo, hi) in zip(rows.tolist(), results.tolist(), strict=True):
            ball = flint.arb(0) if (a, b) == (0, 0) else flint.arb.atan2(flint.arb(a + 0.0), flint.arb(b + 0.0))
            assert not outside(ball, lo, hi), (a, b, lo, hi)


def test_the_part_that_is_not_taken_does_not_matter(device: Device) -> None:
    """log(x) has no value for x < 0; from_formula would rightly refuse it alone."""
    surface = surfaces.from_formula("if(x > 0.001, log(x) + y, x^2 + y)", "sphere:1.5")
    built = program(surface, RANGE, "float32", device.language, "surface_range")
    results = map_rows(device, built, np.array([[-0.5, -0.5, 0.25, 0.25, 0, 0]], np.float32), 2)
    assert 0.49 < results[0, 0] <= 0.5 <= results[0, 1] < 0.51
