"""Hold surface_gradient_range against secants: f's change between two points of a box, over all of the box.

By the mean value theorem f(p) - f(q) is a sum of derivatives in the box times p - q, across kinks too; where f jumps in
between, no derivatives of the box give its change. The exact change comes from float64 intervals about both points, and
from flint's balls wherever those cannot decide.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import flint
import numpy as np

import surfaces
from harness.contract import Precision, Section, Surface
from harness.devices.interface import Device, map_rows
from harness.kernels.assemble import map_program
from harness.kernels.functions import libraries_for, surface_sections
from surfaces.tape import walk
from tests.test_interval_containment import Array, Thin, drawn_boxes, exact_points

NEED = "surface_gradient_range"
GRADIENT = Section(
    "tests: surface_gradient_range over rows",
    """#define INPUTS 6
#define OUTPUTS 9
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    GradientRange g = surface_gradient_range(make_interval(x[0], x[1]), make_interval(x[2], x[3]),
                                             make_interval(x[4], x[5]));
    y[0] = g.value.lo;
    y[1] = g.value.hi;
    y[2] = g.x.lo;
    y[3] = g.x.hi;
    y[4] = g.y.lo;
    y[5] = g.y.hi;
    y[6] = g.z.lo;
    y[7] = g.z.hi;
    y[8] = g.known ? 1.0 : 0.0;
}
""",
)


class ThinJumps(Thin):
    """Add operations that jump, and angles and powers, to float64 intervals; where one is in doubt it holds both."""

    def floor(self, a: Any) -> Any:
        return np.floor(a[0]), np.floor(a[1])

    def sign(self, a: Any) -> Any:
        return np.where(a[0] >= 0.0, 1.0, -1.0), np.where(a[1] >= 0.0, 1.0, -1.0)

    def below(self, a: Any, b: Any) -> Any:
        return np.where(a[1] <= b[0], 1.0, 0.0), np.where(a[0] > b[1], 0.0, 1.0)

    def select(self, c: Any, p: Any, q: Any) -> Any:
        sure, never = np.asarray(c[0]) > 0.9, np.asarray(c[1]) < 0.1
        lo = np.where(sure, p[0], np.where(never, q[0], np.minimum(p[0], q[0])))
        return lo, np.where(sure, p[1], np.where(never, q[1], np.maximum(p[1], q[1])))

    def powr(self, a: Any, q: Any) -> Any:
        low, high = np.maximum(a[0], 0.0) ** float(q), np.maximum(a[1], 0.0) ** float(q)
        slack = 1e-14 * (1.0 + np.abs(np.log(np.maximum(high, 1e-300)))) * high
        return low - slack, high + slack

    def atan2(self, a: Any, b: Any) -> Any:
        corners = [np.arctan2(p, q) for p in a for q in b]
        lo, hi = np.minimum.reduce(corners) - 1e-14, np.maximum.reduce(corners) + 1e-14
        return np.where(hi - lo > 3.0, -4.0, lo), np.where(hi - lo > 3.0, 4.0, hi)


@dataclass(frozen=True)
class Found:
    """Hold what was found on n boxes: how many have known derivatives, how narrow they are, and what is wrong.

    narrow: median width of the derivatives of boxes that are no longer than 1e-4 of the domain, over the largest
    """

    boxes: int
    known: int
    narrow: float
    wrong: list[str]


def second_points(boxes: Array, points: Array, rng: np.random.Generator) -> Array:
    """Return another point of each box [n, 3]: a third differ from `points` in one coordinate alone."""
    share = rng.uniform(size=points.shape).astype(boxes.dtype)
    inner = np.clip(boxes[..., 0] + (boxes[..., 1] - boxes[..., 0]) * share, boxes[..., 0], boxes[..., 1])
    other = np.choose(rng.integers(0, 3, points.shape), [boxes[..., 0], boxes[..., 1], inner])
    one = rng.integers(0, 3, len(points))
    same = (np.arange(3) != one[:, None]) & (rng.uniform(size=len(points)) < 0.34)[:, None]
    return np.where(same, points, other)


def hold(
    surface: Surface, device: Device, precision: Precision, count: int, rng: np.random.Generator, edit: Any = None
) -> Found:
    """Hold the derivatives over `count` random boxes against two points of each. `edit` changes the sections first."""
    sections = [*surface_sections(surface, (NEED,), precision, device.language), GRADIENT]
    program = map_program(edit(sections) if edit else sections, precision, device.language, libraries_for((NEED,)))
    boxes, p = drawn_boxes(surface, count, np.dtype(precision).type, rng)
    q = second_points(boxes, p, rng)
    rows = map_rows(device, program, boxes.reshape(-1, 6), 9).astype(np.float64)
    known = rows[:, 8] > 0.5
    wrong = [f"NaN over {boxes[i].tolist()}" for i in np.flatnonzero(np.isnan(rows).any(axis=1))[:3]]
    finite = np.isfinite(rows[:, 2:8]).all(axis=1)
    wrong += [f"known, but not finite over {boxes[i].tolist()}" for i in np.flatnonzero(known & ~finite)[:3]]
    apart = (p.astype(np.float64) - q.astype(np.float64))[:, :, None]
    with np.errstate(all="ignore"):
        ends = rows[:, 2:8].reshape(-1, 3, 2) * apart
        bounds = np.stack([ends.min(axis=2).sum(axis=1), ends.max(axis=2).sum(axis=1)], axis=1)
        change = _changes(surface, p, q)
        slack = 1e-15 * np.abs(ends).sum(axis=(1, 2))
        sure = (bounds[:, 0] + slack <= change[0]) & (change[1] <= bounds[:, 1] - slack)
    doubt = known & (p != q).any(axis=1) & (~sure if precision == "float32" else True)
    for i in np.flatnonzero(doubt):
        if message := _contradiction(surface, p[i].tolist(), q[i].tolist(), rows[i]):
            wrong.append(f"{message} over {boxes[i].tolist()}")
    small = known & ((boxes[..., 1] - boxes[..., 0]).max(axis=1) < 1e-4 * surface.domain.radius)
    slopes = rows[small, 2:8]
    widths = (slopes[:, 1::2] - slopes[:, ::2]).max(axis=1) / np.maximum(np.abs(slopes).max(axis=1), 1e-30)
    return Found(count, int(known.sum()), float(np.median(widths)) if small.any() else np.inf, wrong)


def _changes(surface: Surface, p: Array, q: Array) -> tuple[Array, Array]:
    """Return float64 intervals that hold f(p) - f(q): two arrays [n]."""
    tape, thin = surfaces.tape_of(surface), ThinJumps()
    values = []
    for points in (p, q):
        coordinates = {axis: (c, c) for axis, c in zip("xyz", points.astype(np.float64).T, strict=True)}
        values.append(walk(tape, thin, coordinates)[0])
    return thin.sub(*values)


def _contradiction(surface: Surface, p: list[float], q: list[float], row: Array) -> str | None:
    """Say how the exact change of f between two points leaves what the derivatives allow; None if it does not."""
    first, second = exact_points([p, q], surfaces.tape_of(surface))
    with flint.ctx.workprec(200):
        change = first - second
        if not change.is_finite():
            return f"f is not defined at {p} or {q}, and derivatives are known"
        allowed = flint.arb(0)
        for k in range(3):
            slope = flint.arb(row[2 + 2 * k]).union(flint.arb(row[3 + 2 * k]))
            allowed += slope * (flint.arb(p[k]) - flint.arb(q[k]))
        if not (change > allowed or change < allowed):
            return None
        low, high = float(allowed.lower()), float(allowed.upper())
    return f"f({p}) - f({q}) is {float(change)}, which is not in [{low}, {high}]"
