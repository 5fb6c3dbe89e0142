"""First-root isolation in Bernstein form, trusted as far as its error bound reaches and no further.

**Source** firsthit's own. Its parts: the fit of szente, section 2.1; Descartes' rule of signs in the Bernstein basis
and de Casteljau's algorithm (Lane, Riesenfeld 1981); running error analysis (Higham 2002, section 3.3); the path of a
halving in one integer instead of a stack, as in beamcasting.

**Theory** Along the ray f is a polynomial; on a piece of it f has at most as many roots as the piece's Bernstein
coefficients have changes of sign, and as many but for an even number. A piece without a change has no root, and one
with a single change has one. So the ray's stay is fitted and halved from the near end, depth first, without a stack:
the path of a piece is one integer. Pieces without a change are left out, and the first one with a single change, whose
far end f itself confirms, holds the first root. Where the fit's coefficients change sign as often as its samples,
every root is between two of these, and nothing is halved.

A sign counts only outside an error bound, TRUST of the worst case of: what f's own roundings may be in the samples
(harness/rounding.py), times what a piece's size makes of them (GROWTH: it falls from the inverse's norm to Lebesgue's
constant); the fit's roundings, from the samples that they come from; and those of each halving. Coefficients inside
the bound leave a piece open. After TRUSTED halvings, what is open or has several changes is sampled and fitted anew,
so that errors are those of its own surroundings, not of the far ends of the ray, where f is a thousand times larger.
What is all noise even then, or the shortest piece, or beyond the FITS-th fit, f's signs decide: at the samples, and
where the fit has its minimum.

**What is promised** Hits are where f itself changes its sign, so there are no false ones outside the grazing class.
Where another answer is 2^-11 domain radii away and the first root's condition times roundoff is below 2^-8, no
crossing is missed, no later root taken, and the error is below the tolerance and what rounding must add; tests hold
random rays over the catalog against that, a million where asked. A touch is a miss, or a hit at the touch where
rounding makes f cross: f does not change its sign there. What else can be lost lies inside the error bound: pairs of
roots between which f does not leave its own noise, or closer than RESOLUTION.

**Changes against the plan** What lies behind a piece without a root is not brought back from kept coefficients but
fitted anew: its errors are smaller, and on a vector of rays it is cheaper, see Speed.

Evaluations counted are those of f.

**Speed** Processor time on opencl:intel, float32, 512x512, in ms, on calyx, Barth sextic, Endraß octic, Barth decic
and 16-ball: 4.3, 6.6, 14.7, 16.9, 19.2; eft_yuksel 4.6, 9.5, 18.2, 28.0, 49.6. That is 1.1 to 2.6 times, 1.6 in the
mean; behind beams 1.7. The 99.9th percentile of its error is larger on the sextic (1.35e-6 against 1.30e-6 of the
radius) and the octic (2.48e-6 against 1.83e-6). What keeps it from more: sampling and fitting alone take a fifth
(decic) to a half (16-ball) of it, and a vector of rays waits for the one that is fitted most often (decic: 19
evaluations a ray, some 30 for the worst of 16).
- Refinement, tried on all: Illinois ended early where f has two scales (errors to 3e-4); ITP never did, but the
  slowest of 16 rays took 18 evaluations; bracketed Newton steps with f's value and the fit's slope take 5: kept.
- Right siblings from kept coefficients: 16-ball 34, decic 21, octic 17; fitted anew 18, 17, 15: kept. Intel's compiler
  runs both sides of a branch that rays do not share, so that the rare restriction was paid for at each step.
- States in one variable, bits of coefficients in an integer, a loop for everything: not vectorised, ten times slower.
- Compensated products below degree 12: 10 % slower, no better answers; their gain is undone by the samples' own
  errors. At 12 and above they save more fits than they cost.
- TRUST 1/64: f's own errors reach 1/25 to 1/12 of their worst case at single points, and sums of them less. 1/8 gives
  the same answers in 1.05 to 1.8 times the time. Going on halving after TRUSTED where nothing is open: fewer
  evaluations, and slower.
- f at the fit's minimum, beside the samples, where all is noise: without it, close pairs of roots are lost at ten
  times the distance (clustered roots, nodes, double lines). Up to 10 % slower.
- f's sign at the far end of an open piece, instead of a new fit: loses pairs of roots by the hundred.
"""

from collections.abc import Mapping
from math import comb

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
SHELLS = 16  # balls with a bound of f's roundings of their own
DEPTHS = 6  # halvings whose growth of errors is tabulated; it falls no further
COORDINATES = 6.0  # unit roundoffs of a point's distance from the centre by which its coordinates may be off


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.fitting import fit_tables, inverse
    from harness.rounding import sample_errors_grow, value_errors

    assert surface.degree is not None
    matrix = inverse(surface.degree, "bernstein", precision)
    return fit_tables(surface.degree, "bernstein", precision) | {
        "VALUE_ERRORS": list(value_errors(surface, SHELLS, COORDINATES)),
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
        Parameter(
            "PAIRS",
            2,
            "pairs of samples beside the root, over which the last step takes f's mean; 0: none",
            sweep=(0, 16),
        ),
        Parameter("APART", 4.0, "distance of these samples, unit roundoffs of the ray's length in the domain"),
        Parameter("COUNTED", 5, "degree up to which changes of sign of coefficients and samples are compared"),
        Parameter("COMPENSATED", 17, "degree from which on the fit is compensated; below, plain products and sums"),
        Parameter("TRUST", 0.015625, "share of the worst case up to which errors are reckoned with"),
        Parameter("TRUSTED", 4, "halvings after which an open piece is fitted anew"),
        Parameter("NOISE", 4.0, "a fitted piece under this many errors is decided by f's signs at the samples"),
        Parameter("RESOLUTION", 2.0**-14, "shortest piece, over the ray's length in the domain"),
        Parameter("WIDENING", 8.0, "how much longer the piece after one that was fitted anew is"),
        Parameter("FITS", 64, "fits of one ray after which f's signs at the samples decide what is open"),
        Parameter("MAX_EVALUATIONS", 4096, "evaluations spent on one ray"),
    ),
    claims=frozenset({"no_false_hit"}),
    accepts=_accepts,
    tables=_tables,
)
