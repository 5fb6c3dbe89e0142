"""The oracle's estimates against the exact polynomial along each ray: all its roots and extrema, isolated by flint."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import mpmath
import numpy as np
import pytest
import sympy
from flint import ctx, fmpq, fmpq_poly

import surfaces
from harness import hardcases
from harness.camera import camera_for, rays_of
from harness.contract import Surface, Truth, TruthStatus, View
from harness.oracle import first_hits

DIGITS = 60  # of irrational constants: 1e-60 off is 1e-30 off where two roots meet
EXACT = 400  # bits
Polynomials = tuple[fmpq_poly, ...]


@dataclass(frozen=True)
class Reference:
    """What the exact polynomial says, in t and scene units."""

    first: float  # NaN without a root
    gap: float  # to the next root; inf where there is none
    margin: float  # contract.Truth's formula at exact extrema


def rational(value: sympy.Expr) -> fmpq:
    near = value if value.is_Rational else sympy.Rational(str(value.evalf(DIGITS)))
    return fmpq(int(near.p), int(near.q))


@cache
def terms(formula: str, parameters: tuple[tuple[str, str], ...]) -> tuple[list[tuple[tuple[int, ...], fmpq]], ...]:
    """Monomials of f and of its three derivatives."""
    surface = surfaces.from_formula(formula, "sphere:1", "any", dict(parameters))
    x, y, z = variables = sympy.symbols("x y z", real=True)
    expr = surfaces.expression(surface)
    expr = expr.xreplace({s: variables["xyz".index(s.name)] for s in expr.free_symbols})
    whole = sympy.Poly(expr, x, y, z)
    return tuple([(m, rational(c)) for m, c in p.terms()] for p in (whole, *(whole.diff(v) for v in variables)))


def along(surface: Surface, ray: np.ndarray) -> Polynomials:
    """f and its gradient on o + t·d."""
    o, d = ([fmpq(*float(v).as_integer_ratio()) for v in part] for part in (ray[:3], ray[3:]))
    powers = []
    for a, b in zip(o, d, strict=True):
        powers.append([fmpq_poly([1])])
        for _ in range(surface.degree):
            powers[-1].append(powers[-1][-1] * fmpq_poly([a, b]))
    result = []
    for monomials in terms(surface.formula, surface.parameters):
        total = fmpq_poly([0])
        for (i, j, k), c in monomials:
            total += c * powers[0][i] * powers[1][j] * powers[2][k]
        result.append(total)
    return tuple(result)
