"""Compute the tables by which bernstein's kernel isolates roots: what rounding leaves certain of coefficients."""

from __future__ import annotations

from math import comb

from harness.contract import Precision, Surface
from harness.kernels.fitting import fit_tables, inverse
from harness.kernels.rounding import sample_errors_grow, value_errors

SHELLS = 16  # balls about the domain's centre, each with its own bound of f's rounding errors
DEPTHS = 6  # halvings for which the tables say how errors grow; further ones change nothing
COORDINATES = 6.0  # error of the coordinates of a ray's point, in unit roundoffs of its distance from the centre


def isolation_tables(surface: Surface, precision: Precision) -> dict[str, list[float]]:
    """Return the tables of the fit in Bernstein form, and those that bound the errors of its coefficients.

    VALUE_ERRORS bounds f's rounding errors in each shell; COLUMNS and GROWTH say what errors of samples become in
    coefficients, and in those of pieces that were halved; BINOMIALS are those of the degree.
    """
    assert surface.degree is not None
    matrix = inverse(surface.degree, "bernstein", precision)
    return fit_tables(surface.degree, "bernstein", precision) | {
        "VALUE_ERRORS": list(value_errors(surface, SHELLS, COORDINATES)),
        "BINOMIALS": [float(comb(surface.degree, j)) for j in range(surface.degree + 1)],
        "COLUMNS": [max(float(abs(row[i])) for row in matrix) for i in range(surface.degree + 1)],
        "GROWTH": sample_errors_grow(surface.degree, precision, DEPTHS),
    }
