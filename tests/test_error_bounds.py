"""The error bounds that lu_lipschitz's kernel reckons with, against the true errors of what it fits."""

from __future__ import annotations

import dataclasses
from functools import cache
from math import comb
from typing import Any

import flint
import numpy as np
import pytest

import surfaces
from harness.contract import Box, Section, Surface
from harness.devices.interface import map_rows
from harness.kernels.assemble import map_program, method_program
from harness.plugins import find_methods
from surfaces.evaluation import tape_of
from surfaces.lowering import real_tape
from surfaces.numbers import Balls
from surfaces.tape import walk

from .conftest import opened, usable_devices

BITS = 512
RAYS = 200
# a row: ray, the ray's stay and a window of it → coefficients, what they may be off by; the same of the slope's
ITEM = """
#define INPUTS 10
#define OUTPUTS (2 * N + 4)
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    Ray ray = make_ray(vec3(x[0], x[1], x[2]), vec3(x[3], x[4], x[5]));
    real s[COEFFICIENTS];
    real b[COEFFICIENTS];
    real d[COEFFICIENTS];
    real e[COEFFICIENTS];
    for (int i = 0; i <= N; i++) s[i] = surface_value(ray_point(ray, x[6] + (x[7] - x[6]) * NODES[i]));
    fit(s, true, true, b);
    for (int j = 0; j < N; j++) d[j] = real(N) * (b[j + 1] - b[j]);
    restrict_to(x[8], x[9], d, N - 1, e);
    for (int j = 0; j <= N; j++) y[j] = b[j];
    for (int j = 0; j < N; j++) y[N + 1 + j] = e[j];
BOUNDS
}
"""
OURS = """
    vec3 o = difference(ray.origin, DOMAIN_CENTER);
    real near = inner_product(o, o);
    real drift = 2.0 * inner_product(o, ray.direction);
    real off = value_error(near + max((drift + x[6]) * x[6], (drift + x[7]) * x[7]));
    y[2 * N + 1] = coefficient_error(off, largest(b, N));
    y[2 * N + 2] = slope_error(off, largest(b, N), largest(d, N - 1), x[9]);
    y[2 * N + 3] = off;
"""


@cache
def _rows(surface: Surface, precision: str) -> Any:
    """[RAYS, 10]: rays from the point nearest the centre, their stay in the domain, and a window of it."""
    rng = np.random.default_rng(11)
    domain, radius = surface.domain, surface.domain.radius
    heading = rng.normal(size=(RAYS, 3))
    heading /= np.linalg.norm(heading, axis=1)[:, None]
    half = np.subtract(domain.upper, domain.lower) / 2 if isinstance(domain, Box) else np.full(3, radius / 2)
    foot = rng.uniform(-0.7, 0.7, (RAYS, 3)) * half
    foot -= (foot * heading).sum(axis=1)[:, None] * heading
    if isinstance(domain, Box):
        with np.errstate(divide="ignore"):
            ends = np.sort(np.stack([(-half - foot) / heading, (half - foot) / heading]), axis=0)
        lo, hi = ends[0].max(axis=1), ends[1].min(axis=1)
    else:
        hi = np.sqrt(radius**2 - (foot**2).sum(axis=1))
        lo = -hi
    start = rng.uniform(0, 1, RAYS) * (rng.random(RAYS) < 0.8)
    window = np.minimum(0.5 ** rng.uniform(0, 8, RAYS), 1 - start)
    rows = np.column_stack([foot + domain.center, heading, lo, hi, start, window])[lo < hi]
    return rows.astype(np.float32 if precision == "float32" else np.float64)


def _program(surface: Surface, precision: Any, bounds: str) -> Any:
    plugin = find_methods().get("lu_lipschitz")
    device = opened(usable_devices()[0].name)
    whole = method_program(
        plugin.method, plugin.folder, plugin.variant({}), surface, precision, device.language, "rays"
    )
    names = [section.origin for section in whole.sections]
    kept = whole.sections[: names.index("methods/lu_lipschitz/kernel.glsl") + 1]
    item = Section("tests: bounds", ITEM.replace("BOUNDS", bounds))
    empty = map_program(item, precision, device.language)
    return device, dataclasses.replace(empty, sections=(*kept, item, empty.sections[-1]))


def _exactly(surface: Surface, row: Any) -> tuple[list[Any], list[Any]]:
    """The exact Bernstein coefficients of f along the ray's stay, and of its slope on the window."""
    n = surface.degree or 0
    number = [flint.arb(float(v)) for v in row]
    tape = real_tape(tape_of(surface))
    values = []
    for i in range(n + 1):
        t = number[6] + (number[7] - number[6]) * i / n
        point = {axis: number[k] + t * number[3 + k] for k, axis in enumerate("xyz")}
        values.append(walk(tape, Balls(), point)[0])
    b = [sum((w * v for w, v in zip(weights, values, strict=True)), flint.arb(0)) for weights in _inverse(n)]
    d = [n * (b[j + 1] - b[j]) for j in range(n)]
    x, share = number[8], number[9] / (1 - number[8])
    for r in range(1, n):
        for j in range(n - r):
            d[j] += x * (d[j + 1] - d[j])
    for r in range(1, n):
        for j in range(n - 1, r - 1, -1):
            d[j] = d[j - 1] + share * (d[j] - d[j - 1])
    return b, d


@cache
def _inverse(n: int) -> list[list[Any]]:
    """What makes Bernstein coefficients of values at i / n."""
    rows = [[flint.fmpq(comb(n, j) * i**j * (n - i) ** (n - j), n**n) for j in range(n + 1)] for i in range(n + 1)]
    return [[flint.arb(v) for v in row] for row in flint.fmpq_mat(rows).inv().tolist()]


def _shares(surface: Surface, precision: Any, bounds: str = OURS) -> tuple[Any, Any]:
    """True error over stated bound, of each ray's worst coefficient and worst slope."""
    device, program = _program(surface, precision, bounds)
    rows, n = _rows(surface, precision), surface.degree or 0
    found = map_rows(device, program, rows, 2 * n + 4).astype(np.float64)
    before, flint.ctx.prec = flint.ctx.prec, BITS
    try:
        worst = []
        for row, line in zip(rows, found, strict=True):
            b, d = _exactly(surface, row)
            error = max(float(abs(flint.arb(v) - w).upper()) for v, w in zip(line[: n + 1], b, strict=True))
            slope = max(float(abs(flint.arb(v) - w).upper()) for v, w in zip(line[n + 1 : 2 * n + 1], d, strict=True))
            worst.append((error / line[2 * n + 1], slope / line[2 * n + 2]))
    finally:
        flint.ctx.prec = before
    shares = np.array(worst)
    return shares[:, 0], shares[:, 1]


# a share of the largest coefficient, whatever f: no bound, since it knows nothing of the samples' roundings
SIZE_ALONE = """
    y[2 * N + 1] = real(8 * N) * UNIT_ROUNDOFF * largest(b, N);
    y[2 * N + 2] = real(8 * N) * UNIT_ROUNDOFF * largest(d, N - 1);
    y[2 * N + 3] = 0.0;
"""
NAMES = ("sphere", "torus", "barth_sextic", "endrass_octic", "barth_decic", "sixteen_ball")


@pytest.mark.one_in(3)
@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("name", NAMES)
def test_no_coefficient_is_off_by_more_than_its_stated_bound(name, precision):
    for shares in _shares(surfaces.get(name), precision):
        assert shares.max() <= 1.0
        assert shares.max() > 1e-3  # it is a bound of these errors, not of anything


def _dense(degree: int) -> Surface:
    rng = np.random.default_rng(degree)
    powers = [rng.multinomial(rng.integers(0, degree + 1), [1 / 3] * 3) for _ in range(30)]
    terms = [f"({rng.uniform(-1, 1):.6f})*x^{i}*y^{j}*z^{k}" for i, j, k in powers]
    return surfaces.from_formula(" + ".join([*terms, f"0.8*x^{degree}"]), "sphere:1.1")


@pytest.mark.one_in(3)
@pytest.mark.parametrize("degree", [1, 3, 7, 13, 20])
def test_the_bounds_hold_on_dense_polynomials(degree):
    for shares in _shares(_dense(degree), "float32"):
        assert shares.max() <= 1.0


@pytest.mark.parametrize("name", ["endrass_octic", "sixteen_ball"])
def test_a_share_of_the_largest_coefficient_is_no_bound(name):
    coefficients, _ = _shares(surfaces.get(name), "float32", SIZE_ALONE)
    assert (coefficients > 1.0).mean() > 0.2
