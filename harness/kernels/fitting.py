"""Compute the tables by which the kernel library `fit` turns a polynomial's values at Chebyshev nodes into
coefficients.

Source: szente, section 2.1. The nodes on x in [-1, 1] are -cos(i pi / n), ascending. The Bernstein basis is that of
(1 + x) / 2 in [0, 1]. The nodes are rounded first, and the inverse matrix is exact for the rounded nodes, so that an
entry's only error is the rounding of the second of its two parts.

The nodes lie symmetrically about 0. Sums of opposite samples therefore determine one half of the coefficients, and
their differences the other half. With s the samples and b or c the coefficients, rows of the two tables are

    monomial    c[2 r] = sum of EVEN[r, i] (s[n-i] + s[i]),      c[2 r + 1] = sum of ODD[r, i] (s[n-i] - s[i])
    Bernstein   (b[n-r] + b[r]) / 2, the same with EVEN,         (b[n-r] - b[r]) / 2, the same with ODD

where i runs from 0 to n/2 for EVEN, with the middle sample of an even n taken once, and to (n-1)/2 for ODD.
`whole_tables` gives the whole inverse matrix instead, as the paper prints it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import Literal

from harness.contract import Precision, Surface, as_float32

Basis = Literal["monomial", "bernstein"]
MAX_DEGREE = 20


def cannot_be_fitted(surface: Surface) -> str | None:
    """Say why no polynomial can be fitted to a surface's function along a ray; None where one can."""
    if surface.degree is None:
        return "not algebraic: along a ray it is no polynomial, which the fit would have to be"
    if 1 <= surface.degree <= MAX_DEGREE:
        return None
    return f"degree {surface.degree}: the fit is for degrees 1 to {MAX_DEGREE}"


def _rounded(value: Fraction, precision: Precision) -> Fraction:
    """Round to a number of the precision."""
    return Fraction(as_float32(float(value)) if precision == "float32" else float(value))


def nodes(degree: int, precision: Precision) -> list[Fraction]:
    """Return degree + 1 nodes on [-1, 1], ascending and exactly symmetric, each a number of the precision."""
    left = [_rounded(Fraction(-math.cos(i * math.pi / degree)), precision) for i in range((degree + 1) // 2)]
    return left + [Fraction(0)] * (degree % 2 == 0) + [-x for x in reversed(left)]


def inverse(degree: int, basis: Basis, precision: Precision) -> list[list[Fraction]]:
    """Return the exact inverse of H[i][j] = h_j(nodes[i]), where h_j are the basis's polynomials.

    Coefficient j of a polynomial is then the sum over i of inverse[j][i] samples[i].
    """
    import flint

    def row(x: Fraction) -> list[Fraction]:
        if basis == "monomial":
            return [x**j for j in range(degree + 1)]
        y = (1 + x) / 2
        return [math.comb(degree, j) * y**j * (1 - y) ** (degree - j) for j in range(degree + 1)]

    matrix = [[flint.fmpq(h.numerator, h.denominator) for h in row(x)] for x in nodes(degree, precision)]
    solved = flint.fmpq_mat(matrix).inv().tolist()
    return [[Fraction(int(v.p), int(v.q)) for v in line] for line in solved]


def _in_two_parts(name: str, values: Iterable[Fraction], precision: Precision) -> dict[str, list[float]]:
    """Return values to about twice the precision, as the tables {name}_HI and {name}_LO, whose sums they are."""
    exact = list(values)
    first = [_rounded(value, precision) for value in exact]
    return {
        f"{name}_HI": [float(value) for value in first],
        f"{name}_LO": [float(value - hi) for value, hi in zip(exact, first, strict=True)],
    }


def whole_tables(degree: int, basis: Basis, precision: Precision) -> dict[str, list[float]]:
    """Return the inverse matrix row by row, as the tables INVERSE_HI and INVERSE_LO.

    As szente prints it, the nodes are in double precision, whatever the kernels' precision, and entries are rounded to
    double precision before they are split in two parts.
    """
    rows = inverse(degree, basis, "float64")
    doubles = (Fraction(float(value)) for row in rows for value in row)
    return _in_two_parts("INVERSE", doubles, precision)


def fit_tables(degree: int, basis: Basis, precision: Precision) -> dict[str, list[float]]:
    """Return the tables NODES, EVEN_HI, EVEN_LO, ODD_HI and ODD_LO, row by row.

    NODES are on [-1, 1] for the monomial basis, on [0, 1] for the Bernstein basis.
    """
    exact, n = inverse(degree, basis, precision), degree
    if basis == "monomial":
        even = [[exact[2 * r][n - i] for i in range(n // 2 + 1)] for r in range(n // 2 + 1)]
        odd = [[exact[2 * r + 1][n - i] for i in range((n + 1) // 2)] for r in range((n + 1) // 2)]
    else:
        even = [[(exact[n - r][n - i] + exact[r][n - i]) / 2 for i in range(n // 2 + 1)] for r in range(n // 2 + 1)]
        odd = [[(exact[n - r][n - i] - exact[r][n - i]) / 2 for i in range((n + 1) // 2)] for r in range((n + 1) // 2)]
    parameters = [x if basis == "monomial" else (1 + x) / 2 for x in nodes(degree, precision)]
    tables = {"NODES": [float(_rounded(x, precision)) for x in parameters]}
    for name, rows in (("EVEN", even), ("ODD", odd)):
        tables |= _in_two_parts(name, (value for row in rows for value in row), precision)
    return tables


def derivative_factors(degree: int, basis: Basis) -> list[float]:
    """Return factors that make the coefficients of all derivatives, up to one common factor each.

    The result has degree + 1 rows of degree + 1 numbers; row d is for the derivative of degree d, which is number
    n - d with n the polynomial's degree. In the monomial basis its number j is binomial(n - d + j, j), the factor of
    coefficient n - d + j. In the Bernstein basis it is binomial(d, j), the factor of the (n - d)th difference number j,
    which makes the binomial part of the coefficient.
    """
    n = degree
    return [
        float(math.comb(d if basis == "bernstein" else n - d + j, j) if j <= d else 0)
        for d in range(n + 1)
        for j in range(n + 1)
    ]
