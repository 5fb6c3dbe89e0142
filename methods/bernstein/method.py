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
(harness/kernels/rounding.py), times what a piece's size makes of them (GROWTH: it falls from the inverse's norm to
Lebesgue's constant); the fit's roundings, from the samples that they come from; and those of each halving.
Coefficients inside the bound leave a piece open. After TRUSTED halvings, what is open or has several changes is
sampled and fitted anew, so that errors are those of its own surroundings, not of the far ends of the ray, where f is a
thousand times larger. What is noise even then, or the shortest piece, or beyond the FITS-th fit, f's signs decide: at
the samples, and where the fit has its minimum.

What a root is off by is mostly what f's value there is off by, and that is another thing one float further on. So the
last of Newton's steps takes the mean of f over PAIRS pairs of points about the root, a few roundoffs apart: the median
error falls to two thirds, with 16 pairs to half.

**What is promised** Hits are where f's computed value changes its sign, so there are false ones on drowned rays alone,
whose |f| falls under what its roundings may be. A hit is not asked to leave that bound: on such rays as many hits are
real, and would be lost.
Where another answer is 2^-11 domain radii away and the first root's condition times roundoff is below 2^-8, no
crossing is missed, no later root taken, and the error is below the tolerance and what rounding must add; tests hold
random rays over the catalog against that, a million where asked, and ten million were. A touch is a miss, or a hit at
the touch where rounding makes f cross: f does not change its sign there. What else can be lost lies inside the error
bound: pairs of roots between which f does not leave its own noise. On the families of hard rays no other float32 method
holds out longer. In float64 the default TOLERANCE ends Newton's steps too soon among roots that lie close together, and
six families break it a rung or two before others; with 2^-30 it is right on all 14,727 rays that float64 can decide.

**Changes against the plan** What lies behind a piece without a root is not brought back from kept coefficients but
fitted anew: its errors are smaller, and on a vector of rays it is cheaper, see Speed. Compensated products begin at
degree 17 only, see there.

Evaluations counted are those of f.

**Speed** `firsthit run configs/front.toml`, float32, on calyx, Barth sextic, Endraß octic, Barth decic and 16-ball, no
wrong ray, at 1024x1024 on two cores, in ms: on opencl:intel 8.1, 11.5, 22.8, 26.8 and 30.5, eft_yuksel 8.3, 17.3, 33.7,
50.9 and 97.7: 1.8 times in the mean, and behind beams 2.5. On opengl:llvmpipe 40, 33, 48, 59 and 116, eft_yuksel 93,
144, 253, 447 and 960: 5.6 times, and behind beams 6.7. The 99.9th percentile of the error is no larger behind beams
(6.5e-6 of the radius against 7.3e-6 on the octic); without, it is 7.9e-6 there and smaller elsewhere. Where both have
beams: 1.8 and 5.2 times. What keeps it from more on opencl:intel is a vector of rays that waits for the one that is
fitted most often: sampling, fitting and the last steps take a quarter (decic) to over a half (calyx) of the time, so
that isolation at no cost at all would make it 5.8 times in the mean.
On the front of speed and largest error it is there on all twelve surfaces of degree 5 and more, on both devices and at
both sizes; of those of lower degree not on the horn torus (analytic, newton) nor, at 512x512, on the spindle torus
(newton).
- Refinement, tried on all: Illinois ended early where f has two scales (errors to 3e-4); ITP never did, but the
  slowest of 16 rays took 18 evaluations; bracketed Newton steps with f's value and the fit's slope take 5: kept.
- The mean of f: two pairs cost 1 to 10 %, 16 pairs up to 20 %, since all rays of a vector take them alike.
- Right siblings from kept coefficients: 16-ball 34, decic 21, octic 17 ms of processor time at 512x512; fitted anew 18,
  17, 15: kept. Intel's compiler runs both sides of a branch that rays do not share, so that the rare restriction was
  paid for at each step.
- New fits instead of halving, from the first crossing of the control polygon on: 0.1 to 0.8 times as fast, since only
  halving brings GROWTH down. Deciding convex pieces by f at their minimum: fewer fits, each dearer, 0.6 to 0.9 times.
- States in one variable, bits of coefficients in an integer, a loop for everything: not vectorised, ten times slower.
- Compensated products: below degree 12 they gain nothing, undone by the samples' own errors. From 12 to 16 plain ones
  take 0.7 to 0.96 times as long on five surfaces and 1.35 on the sixth, on opengl:llvmpipe 0.7. Compensated only where
  a piece is fitted anew (szente's future work): 1.2 times as long on the 16-ball. Degree 20 takes seven times as long
  as 18 on opencl:intel, whose compiler unrolls the halving no more.
- TRUST 1/64: f's own errors reach 1/25 to 1/12 of their worst case at single points, and sums of them less. 1/8 gives
  the same answers in 1.05 to 1.8 times the time. The fit's roundings count double: else 18 of two million rays of the
  decic took a later root. Going on halving after TRUSTED where nothing is open: fewer evaluations, and slower.
- NOISE 4 against 1: 0.9 times as long on the octic, and 16 of two million of its rays no longer run out of fits.
- f at the fit's minimum, beside the samples, where all is noise: without it, close pairs of roots are lost at ten
  times the distance (clustered roots, nodes, double lines). Up to 10 % slower.
- f's sign at the far end of an open piece, instead of a new fit: loses pairs of roots by the hundred.
- Blocks of 4 by 4 pixels for the 16 rays of a vector: 0.87 to 0.97 times as long here from degree 5 on, but 1.26 for
  newton on the torus: the harness keeps rows.
- A prepass that hands each tile of 16 by 16 pixels the very depths of its hits, at no cost: 1.1 to 1.9 times, so that
  affine arithmetic in the beams (beamcasting's future work) could gain no more than that, and was not tried.
"""

from collections.abc import Mapping
from math import comb

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
SHELLS = 16  # balls with a bound of f's roundings of their own
DEPTHS = 6  # halvings whose growth of errors is tabulated; it falls no further
COORDINATES = 6.0  # unit roundoffs of a point's distance from the centre by which its coordinates may be off


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.fitting import fit_tables, inverse
    from harness.kernels.rounding import sample_errors_grow, value_errors

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
        Parameter("WIDENING", 8.0, "how much longer the piece after one that was fitted anew is"),
        Parameter("FITS", 64, "fits of one ray after which f's signs at the samples decide what is open"),
        Parameter("MAX_EVALUATIONS", 4096, "evaluations spent on one ray"),
    ),
    claims=frozenset({"no_false_hit"}),
    accepts=_accepts,
    tables=_tables,
)
