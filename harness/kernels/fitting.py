"""Tables for the kernel library `fit`: what turns samples of a polynomial at Chebyshev nodes into its coefficients.

Source: szente, section 2.1. On x in [-1, 1] the nodes are -cos(i pi / n), ascending; the Bernstein basis is that of
(1 + x) / 2 in [0, 1]. The nodes are rounded first and the inverse is exact for the rounded ones, so that a table's only
error is that of its last part.

Nodes lie symmetrically, so that sums of opposite samples determine one half of the coefficients and differences the
other. With s the samples, rows of the two tables are

    monomial    c[2 r] = sum of EVEN[r, i] (s[n-i] + s[i]),      c[2 r + 1] = sum of ODD[r, i] (s[n-i] - s[i])
    Bernstein   (b[n-r] + b[r]) / 2, the same with EVEN,         (b[n-r] - b[r]) / 2, the same with ODD

over i = 0 … n/2, the middle sample of an even n taken once, and over i = 0 … (n-1)/2. `whole_tables` gives the inverse
as the paper has it instead.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import Literal

from harness.contract import Precision, as_float32

Basis = Literal["monomial", "bernstein"]
MAX_DEGREE = 20


def _rounded(value: Fraction, precision: Precision) -> Fraction:
    return Fraction(as_float32(float(value)) if precision == "float32" else float(value))


def nodes(degree: int, precision: Precision) -> list[Fraction]:
    """degree + 1 nodes on [-1, 1], ascending, exactly symmetric, each a number of the precision."""
    left = [_rounded(Fraction(-math.cos(i * math.pi / degree)), precision) for i in range((degree + 1) // 2)]
    return left + [Fraction(0)] * (degree % 2 == 0) + [-x for x in reversed(left)]


def inverse(degree: int, basis: Basis, precision: Precision) -> list[list[Fraction]]:
    """The exact inverse of H[i][j] = h_j(nodes[i]): coefficient j is the sum over i of inverse[j][i] samples[i]."""
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
    """The values to about twice the precision: tables {name}_HI and {name}_LO."""
    exact = list(values)
    first = [_rounded(value, precision) for value in exact]
    return {
        f"{name}_HI": [float(value) for value in first],
        f"{name}_LO": [float(value - hi) for value, hi in zip(exact, first, strict=True)],
    }


def whole_tables(degree: int, basis: Basis, precision: Precision) -> dict[str, list[float]]:
    """INVERSE_HI and INVERSE_LO, row by row, as szente prints it: of nodes in double precision, whatever kernels make
    of the nodes, and rounded to double precision before it is parted."""
    rows = inverse(degree, basis, "float64")
    doubles = (Fraction(float(value)) for row in rows for value in row)
    return _in_two_parts("INVERSE", doubles, precision)


def fit_tables(degree: int, basis: Basis, precision: Precision) -> dict[str, list[float]]:
    """NODES, and EVEN and ODD in two parts each (…_HI, …_LO), row by row."""
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
    """Row d, of degree + 1 numbers: what makes the coefficients of a (degree - d)th derivative, up to one factor.

    Monomial: binomial(n - d + j, j), to multiply coefficient n - d + j with. Bernstein: binomial(d, j), to multiply the
    (n - d)th difference number j with, and to make it part of the coefficient.
    """
    n = degree
    return [
        float(math.comb(d if basis == "bernstein" else n - d + j, j) if j <= d else 0)
        for d in range(n + 1)
        for j in range(n + 1)
    ]
