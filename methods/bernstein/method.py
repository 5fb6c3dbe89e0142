"""First-root isolation in Bernstein form, trusted as far as its error bound reaches and no further.

**Source** firsthit's own. Its parts: the fit of szente, section 2.1; Descartes' rule of signs in the Bernstein basis
and de Casteljau's algorithm (Lane, Riesenfeld 1981); running error analysis (Higham 2002, section 3.3); the path of a
halving in one integer instead of a stack, as in beamcasting.

**Theory** Along the ray f is a polynomial; on a piece of it f has at most as many roots as the piece's Bernstein
coefficients have changes of sign, and as many but for an even number. A piece without a change has no root, and one
with a single change has one. So the ray's stay is halved from the near end, depth first, pieces without a change are
left out, and the first piece with one change, whose ends f itself confirms, holds the first root. A sign counts only
outside an error bound: what f's own roundings may be in the samples (harness/rounding.py), times what a piece's depth
makes of them (GROWTH: it falls from the inverse's norm to Lebesgue's constant), and the roundings of fit and halvings,
which run along. Coefficients inside the bound leave a piece open. An open piece is halved; after TRUSTED halvings it
is sampled and fitted anew, so that errors are those of its own surroundings, not of the far ends of the ray, where f
is a thousand times larger; and where even that is all noise, f's signs at the samples decide. A right half is either
what the halving of its parent left over, or comes from the coefficients that were fitted, so that errors do not pile
up.

**What is claimed** Hits are where f itself changes its sign, so there are no false ones outside the grazing class. What
can be lost lies inside the error bound: pairs of roots, and touches, between which f does not rise above its own noise.

Evaluations counted are those of f.
"""

from collections.abc import Mapping
from math import comb

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
SHELLS = 16  # balls with a bound of f's roundings of their own
DEPTHS = 6  # halvings whose growth of errors is tabulated; it falls no further
COORDINATES = 6.0  # unit roundoffs of a point's distance from the centre by which its coordinates may be off


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.fitting import fit_tables
    from harness.rounding import sample_errors_grow, value_errors

    assert surface.degree is not None
    return fit_tables(surface.degree, "bernstein", precision) | {
        "VALUE_ERRORS": list(value_errors(surface, SHELLS, COORDINATES)),
        "BINOMIALS": [float(comb(surface.degree, j)) for j in range(surface.degree + 1)],
        "GROWTH": sample_errors_grow(surface.degree, precision, DEPTHS),
    }


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not algebraic: along a ray it is no polynomial, which the fit would have to be"
    if 1 <= surface.degree <= MAX_DEGREE:
        return None
    return f"degree {surface.degree}: the fit is for degrees 1 to {MAX_DEGREE}"


METHOD = Method(
    name="bernstein",
    source="firsthit",
    needs=("surface_value",),
    libraries=("dual", "fit", "polynomial", "fit_samples"),
    parameters=(
        Parameter(
            "TOLERANCE",
            2.0**-18,
            "last step of the refinement, over the ray's length in the domain",
            finer="down",
            sweep=(2.0**-8, 2.0**-12, 2.0**-22),
            per="2.0 * DOMAIN_RADIUS",
        ),
        Parameter("COMPENSATED", 12, "degree from which on the fit is compensated; below, plain products and sums"),
        Parameter("TRUST", 0.015625, "share of the worst case up to which errors are reckoned with"),
        Parameter("TRUSTED", 4, "halvings after which an open piece is fitted anew"),
        Parameter("NOISE", 1.0, "a fitted piece under this many errors is decided by f's signs at the samples"),
        Parameter("RESOLUTION", 2.0**-14, "shortest piece, over the ray's length in the domain"),
        Parameter("WIDENING", 8.0, "how much longer the piece after one that was fitted anew is"),
        Parameter("FITS", 24, "fits of one ray after which f's signs at the samples decide what is open"),
        Parameter("MAX_EVALUATIONS", 4096, "evaluations spent on one ray"),
    ),
    claims=frozenset({"no_false_hit"}),
    accepts=_accepts,
    tables=_tables,
)
