"""Interval extensions hold on every device: the exact value at points of boxes by the hundred thousand.

The exact value comes from float64 intervals about the point, a unit in the last place wider at every operation, and
from flint's balls wherever those cannot decide. FIRSTHIT_BOXES sets the boxes per surface and device.
"""

from __future__ import annotations

import os
from typing import Any

import flint
import numpy as np
import pytest
from numpy.typing import NDArray

import surfaces
from harness.contract import Precision, Section, Surface
from harness.devices.interface import Device, map_rows
from harness.kernels.assemble import Language, map_program
from harness.kernels.functions import libraries_for, surface_sections, unsupported
from harness.kernels.sections import KERNELS
from surfaces.numbers import Balls
from surfaces.tape import Tape, walk

BOXES = int(os.environ.get("FIRSTHIT_BOXES", "40000"))
EXACT_BOXES = 1500  # decided by balls alone, where float64 is the precision under test
FORMULAS = {
    "quotients": "x/(1.5 + y^2) - z/(2 + sin(x))",
    "roots": "sqrt(x^2 + y^2) - abs(z) + sqrt(2 + x)",
    "distances": "sqrt(x^2 + y^2 + z^2) - 0.5 - sqrt(abs(x))",
    "waves": "sin(3*x)*cos(5*y) + sin(20*z + cos(x)) + tan(0.3*z)",
    "logs": "log(2.5 + x*y) - exp(3*z)",
    "extremes": "max(x, min(y, z) - 0.1, abs(x - y)) - pi/4",
    "powers": "x^3 - 0.1*y^7 + z^5*x^6 - phi*(y - 1/3)^4",
}
CATALOG = ("sphere", "torus", "barth_sextic", "endrass_octic", "barth_decic", "sixteen_ball", "chmutov", "blinn_blob")
FAMILIES = [surfaces.get(name) for name in CATALOG]
FAMILIES += [surfaces.from_formula(text, "sphere:1.5", name) for name, text in FORMULAS.items()]
RANGE = Section(
    "tests: surface_range over rows",
    """#define INPUTS 6
#define OUTPUTS 2
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    Interval a = surface_range(make_interval(x[0], x[1]), make_interval(x[2], x[3]), make_interval(x[4], x[5]));
    y[0] = a.lo;
    y[1] = a.hi;
}
""",
)
RANGE_ALONG = Section(
    "tests: surface_range_along over rows",
    """#define INPUTS 8
#define OUTPUTS 2
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    Interval a = surface_range_along(make_ray(vec3(x[0], x[1], x[2]), vec3(x[3], x[4], x[5])), x[6], x[7]);
    y[0] = a.lo;
    y[1] = a.hi;
}
""",
)
Array = NDArray[Any]


class Thin:
    """float64 intervals as pairs of arrays (lo, hi), one unit in the last place wider at every operation."""

    @staticmethod
    def wide(lo: Array, hi: Array, steps: int = 1) -> tuple[Array, Array]:
        for _ in range(steps):
            lo, hi = np.nextafter(lo, -np.inf), np.nextafter(hi, np.inf)
        return lo, hi

    def const(self, value: Any) -> Any:
        return self.wide(np.float64(float(value)), np.float64(float(value)))

    def pi(self) -> Any:
        return self.wide(np.float64(np.pi), np.float64(np.pi))

    def e(self) -> Any:
        return self.wide(np.float64(np.e), np.float64(np.e))

    def add(self, a: Any, b: Any) -> Any:
        return self.wide(a[0] + b[0], a[1] + b[1])

    def neg(self, a: Any) -> Any:
        return -a[1], -a[0]

    def sub(self, a: Any, b: Any) -> Any:
        return self.add(a, self.neg(b))

    def mul(self, a: Any, b: Any) -> Any:
        products = [p * q for p in a for q in b]
        return self.wide(np.minimum.reduce(products), np.maximum.reduce(products))

    def sqr(self, a: Any) -> Any:
        return self.mul(a, a)

    def powi(self, a: Any, n: int) -> Any:
        return a if n == 1 else self.mul(a, self.powi(a, n - 1))

    def div(self, a: Any, b: Any) -> Any:
        return self.mul(a, self.wide(1.0 / b[1], 1.0 / b[0]))  # no divisor here reaches zero

    def min(self, a: Any, b: Any) -> Any:
        return np.minimum(a[0], b[0]), np.minimum(a[1], b[1])

    def max(self, a: Any, b: Any) -> Any:
        return np.maximum(a[0], b[0]), np.maximum(a[1], b[1])

    def abs(self, a: Any) -> Any:
        return self.max(a, self.neg(a))

    def sqrt(self, a: Any) -> Any:
        return self.wide(np.sqrt(np.maximum(a[0], 0.0)), np.sqrt(a[1]))

    def exp(self, a: Any) -> Any:
        return self.wide(np.exp(a[0]), np.exp(a[1]), 4)

    def log(self, a: Any) -> Any:
        return self.wide(np.log(a[0]), np.log(a[1]), 4)

    def sin(self, a: Any) -> Any:
        middle = np.sin(0.5 * (a[0] + a[1]))
        slack = (a[1] - a[0]) + 4.0 * np.spacing(1.0)
        return middle - slack, middle + slack

    def cos(self, a: Any) -> Any:
        middle = np.cos(0.5 * (a[0] + a[1]))
        slack = (a[1] - a[0]) + 4.0 * np.spacing(1.0)
        return middle - slack, middle + slack

    def tan(self, a: Any) -> Any:
        return self.div(self.sin(a), self.cos(a))


def exact_points(points: list[list[Any]], tape: Tape) -> list[Any]:
    """The surface's value at each point as a ball of 200 bits; coordinates are balls or floats."""
    with flint.ctx.workprec(200):
        return [walk(tape, Balls(), dict(zip("xyz", map(flint.arb, p), strict=True)))[0] for p in points]


def outside(ball: Any, lo: float, hi: float) -> bool:
    """Whether the ball is not inside [lo, hi]; a NaN end holds nothing."""
    with flint.ctx.workprec(200):
        above = lo == -np.inf or bool(ball >= flint.arb(lo))
        below = hi == np.inf or bool(ball <= flint.arb(hi))
        return not (above and below)


def escapes(surface: Surface, coordinates: Any, points: Any, results: Array, exact: bool) -> list[int]:
    """Rows whose result does not hold the exact value. `coordinates`: x, y, z as Thin; `points(i)`: row i for balls."""
    tape = surfaces.tape_of(surface)
    rows = np.arange(len(results))
    if not exact:
        with np.errstate(all="ignore"):
            lo, hi = walk(tape, Thin(), dict(zip("xyz", coordinates, strict=True)))[0]
        rows = rows[~((results[:, 0] <= lo) & (hi <= results[:, 1]))]
    balls = exact_points([points(i) for i in rows], tape)
    return [int(i) for i, ball in zip(rows, balls, strict=True) if outside(ball, *results[i])]


def drawn_boxes(surface: Surface, count: int, kind: Any, rng: np.random.Generator) -> tuple[Array, Array]:
    """Boxes [n, 3, 2] in the domain, widths from 1e-7 to 1, and in each a point [n, 3]: an end two times in three."""
    middle = rng.uniform(-1.0, 1.0, (count, 3)) * surface.domain.radius / np.sqrt(3.0) + surface.domain.center
    half = surface.domain.radius * 10.0 ** rng.uniform(-7.0, -0.5, (count, 3)) * rng.integers(0, 2, (count, 3))
    inside = surface.domain.radius * 0.999
    boxes = np.clip(np.stack([middle - half, middle + half], axis=2), -inside, inside).astype(kind)
    inner = boxes[..., 0] + (boxes[..., 1] - boxes[..., 0]) * rng.uniform(size=(count, 3)).astype(kind)
    inner = np.clip(inner, boxes[..., 0], boxes[..., 1])
    choice = rng.integers(0, 3, (count, 3))
    return boxes, np.choose(choice, [boxes[..., 0], boxes[..., 1], inner])


def program(surface: Surface, item: Section, precision: Precision, language: Language, need: str) -> Any:
    sections = surface_sections(surface, (need,), precision, language)
    return map_program([*sections, item], precision, language, libraries_for((need,)))


def usable(surface: Surface, device: Device, precision: Precision) -> None:
    if precision == "float64" and not device.info.float64:
        pytest.skip("no float64 here")
    if reason := unsupported(surface, precision, device.language):
        pytest.skip(reason)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("surface", FAMILIES, ids=lambda s: s.name)
def test_range_holds_the_value_at_points_of_boxes(surface: Surface, device: Device, precision: Precision) -> None:
    usable(surface, device, precision)
    exact, kind = precision == "float64", np.dtype(precision).type
    rng = np.random.default_rng(len(surface.formula))
    boxes, points = drawn_boxes(surface, EXACT_BOXES if exact else BOXES, kind, rng)
    built = program(surface, RANGE, precision, device.language, "surface_range")
    results = map_rows(device, built, boxes.reshape(-1, 6), 2).astype(np.float64)
    coordinates = [(c, c) for c in points.astype(np.float64).T]
    found = escapes(surface, coordinates, lambda i: [float(c) for c in points[i]], results, exact)
    assert not found, (
        f"{len(found)} of {len(boxes)}: box {boxes[found[0]]}, point {points[found[0]]}, {results[found[0]]}"
    )


@pytest.mark.parametrize("surface", FAMILIES, ids=lambda s: s.name)
def test_range_is_no_wider_than_needed(surface: Surface, device: Device) -> None:
    """On a point the range is a few hundred roundings of the largest values met, so that it can decide anything."""
    usable(surface, device, "float32")
    points = drawn_boxes(surface, 2000, np.float32, np.random.default_rng(7))[1]
    built = program(surface, RANGE, "float32", device.language, "surface_range")
    results = map_rows(device, built, np.repeat(points, 2, axis=1), 2).astype(np.float64)
    scale = np.abs(surfaces.evaluate(surface, points.astype(np.float64))).max()
    assert np.median(results[:, 1] - results[:, 0]) < 1e-4 * scale


@pytest.mark.parametrize("surface", FAMILIES, ids=lambda s: s.name)
def test_range_along_holds_the_value_at_points_of_the_ray(surface: Surface, device: Device) -> None:
    usable(surface, device, "float32")
    rng = np.random.default_rng(len(surface.formula))
    count = BOXES // 4
    origins = rng.uniform(-0.3, 0.3, (count, 3)) * surface.domain.radius + surface.domain.center
    directions = rng.normal(size=(count, 3))
    directions[: count // 10, 0] = 0.0
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    span = np.sort(rng.uniform(-0.4, 0.4, (count, 2)) * surface.domain.radius, axis=1)
    span[: count // 2, 1] = span[: count // 2, 0] + 1e-5 * np.abs(span[: count // 2, 1])
    rows = np.hstack([origins, directions, span]).astype(np.float32)
    middle = np.clip(rows[:, 6:].mean(axis=1).astype(np.float32), rows[:, 6], rows[:, 7])
    t = np.choose(rng.integers(0, 3, count), [rows[:, 6], rows[:, 7], middle]).astype(np.float64)
    built = program(surface, RANGE_ALONG, "float32", device.language, "surface_range_along")
    results = map_rows(device, built, rows, 2).astype(np.float64)
    wide = rows.astype(np.float64)
    thin = Thin()
    coordinates = [thin.add((wide[:, k],) * 2, thin.mul((wide[:, 3 + k],) * 2, (t, t))) for k in range(3)]

    def point(i: int) -> list[Any]:
        with flint.ctx.workprec(200):
            return [flint.arb(wide[i, k]) + flint.arb(wide[i, 3 + k]) * flint.arb(t[i]) for k in range(3)]

    found = escapes(surface, coordinates, point, results, exact=False)
    assert not found, f"{len(found)} of {count}: ray {rows[found[0]]}, t {t[found[0]]}, {results[found[0]]}"


@pytest.mark.parametrize("surface", FAMILIES[:2] + FAMILIES[8:], ids=lambda s: s.name)
def test_range_of_nan_and_infinity_is_not_bounded(surface: Surface, device: Device) -> None:
    """NaN anywhere, or an infinite end, must never come back as a bound that excludes something."""
    usable(surface, device, "float32")
    used = [op.args[0] for op in surfaces.tape_of(surface).ops if op.name == "var"]
    rows = []
    for axis in ("xyz".index(name) for name in used):
        for lo, hi in ((np.nan, 0.5), (-0.5, np.nan), (np.nan, np.nan), (-np.inf, np.inf), (-3e38, 3e38)):
            row = np.full(6, 0.25)
            row[2 * axis : 2 * axis + 2] = lo, hi
            rows.append(row)
    built = program(surface, RANGE, "float32", device.language, "surface_range")
    results = map_rows(device, built, np.array(rows, np.float32), 2)
    tape = surfaces.tape_of(surface)
    for row, (lo, hi) in zip(rows, results, strict=True):
        assert not np.isnan(lo) and not np.isnan(hi), row
        for sample in (-1.0, 0.0, 0.4, 2.0):
            point = [sample if row[2 * k] != row[2 * k + 1] else 0.25 for k in range(3)]
            ball = exact_points([point], tape)[0]
            assert ball.is_nan() or not outside(ball, float(lo), float(hi)), (row, lo, hi)


def test_arithmetic_without_outward_rounding_would_be_caught(device: Device) -> None:
    """The same boxes find escapes once `outward` widens by nothing."""
    text = (KERNELS / "lib" / "interval.glsl").read_text(encoding="utf-8")
    broken = text.replace("2.0 * k * UNIT_ROUNDOFF", "0.0 * k").replace(" - REAL_TINY", "").replace(" + REAL_TINY", "")
    assert broken.count("0.0 * k") == 1
    assert "REAL_TINY," not in broken.split("outward(")[1]
    surface = surfaces.get("barth_sextic")
    boxes, points = drawn_boxes(surface, BOXES, np.float32, np.random.default_rng(3))
    sections = surface_sections(surface, ("surface_range",), "float32", device.language)
    items = [Section("tests: no outward rounding", broken), *sections, RANGE]
    results = map_rows(device, map_program(items, "float32", device.language), boxes.reshape(-1, 6), 2).astype(
        np.float64
    )
    coordinates = [(c, c) for c in points.astype(np.float64).T]
    assert escapes(surface, coordinates, lambda i: [float(c) for c in points[i]], results, exact=False)
