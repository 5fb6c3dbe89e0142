"""First roots by tiles (docstring to come)."""

from collections.abc import Mapping
from math import comb

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
SHELLS = 16  # balls about the domain's centre, each with its own bound of f's rounding errors
DEPTHS = 6  # halvings for which the tables say how errors grow
COORDINATES = 12.0  # error of a point's coordinates, in unit roundoffs of its distance from the centre


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.fitting import fit_tables, inverse
    from harness.kernels.rounding import sample_errors_grow, value_errors
    from harness.kernels.tiles import REACH

    assert surface.degree is not None
    matrix = inverse(surface.degree, "bernstein", precision)
    return fit_tables(surface.degree, "bernstein", precision) | {
        "TILE_ERRORS": list(value_errors(surface, SHELLS, COORDINATES, REACH)),
        "VALUE_ERRORS": list(value_errors(surface, SHELLS, 6.0)),
        "BINOMIALS": [float(comb(surface.degree, j)) for j in range(surface.degree + 1)],
        "COLUMNS": [max(float(abs(row[i])) for row in matrix) for i in range(surface.degree + 1)],
        "GROWTH": sample_errors_grow(surface.degree, precision, DEPTHS),
    }


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not algebraic: along a ray it is no polynomial, which the fit would have to be"
    if 1 <= surface.degree <= MAX_DEGREE:
        return None
    return f"degree {surface.degree}: the fit is for degrees 1 to {MAX_DEGREE}"


METHOD = Method(
    name="tiles",
    source="firsthit",
    casts="tiles",
    rest="bernstein",
    needs=("surface_value",),
    libraries=("dual", "fit", "polynomial", "fit_samples"),
    parameters=(
        Parameter(
            "TOLERANCE",
            2.0**-18,
            "last step of the refinement, over the domain's diameter",
            finer="down",
            per="2.0 * DOMAIN_RADIUS",
        ),
        Parameter(
            "PAIRS",
            2,
            "pairs of samples around the root, over which the last step takes the mean of f; 0: no such step",
        ),
        Parameter(
            "APART", 4.0, "distance between neighbouring samples of PAIRS, in unit roundoffs of the domain's diameter"
        ),
        Parameter("SECANT", 2.0**-12, "steps longer than this, in domain radii, set the slope to the secant's"),
        Parameter("STEPS", 6, "most steps of the refinement of a pixel, before it is cast by itself"),
        Parameter("TRUST", 0.015625, "share of the worst case of the rounding errors that counts as their bound"),
        Parameter("TRUSTED", 6, "halvings of a fitted piece before a tile is open"),
        Parameter("WIDENING", 8.0, "length of the next piece to be fitted, over that of the piece just decided"),
        Parameter("REFITS", 1, "how often a tile that is open is fitted anew before its quarters are"),
        Parameter("PACKET_FITS", 4, "fits of a block of open pixels before those still open are cast by themselves"),
        Parameter(
            "AHEAD", 4.0, "length of the first piece that is fitted in an open tile's parts, over the open piece"
        ),
        Parameter("LEANS", 1, "1: an open tile is tried once more with nodes in planes that lean as the surface does"),
        Parameter("SHORTEST", 2.0, "shortest piece of a tile, over the tile's side"),
        Parameter("COUNTED", 5, "as bernstein's"),
        Parameter("COMPENSATED", 17, "as bernstein's"),
        Parameter("NOISE", 4.0, "as bernstein's"),
        Parameter("FITS", 64, "as bernstein's"),
        Parameter("MAX_EVALUATIONS", 4096, "as bernstein's"),
    ),
    claims=frozenset({"no_false_hit"}),
    accepts=_accepts,
    tables=_tables,
)
