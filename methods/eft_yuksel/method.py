"""Polynomial fit along the ray by error-free transforms; Yuksel's bracketing; refinement on the original function.

**Source** szente, section 2 (fit: 2.1, equation 1; roots: 2.2); C. Yuksel, High-performance polynomial root finding
for graphics, 2022. Products and sums: Ogita, Rump, Oishi 2005 (Dot2), with the inverse matrix in two parts.

**Theory** f along the ray is a polynomial of f's degree n, known from n + 1 samples. Between neighbouring critical
points it is monotone, so one root at most lies there, where the ends differ in sign. Critical points are the roots of
the derivative, themselves between the derivative's critical points, and so on, from the linear derivative up. Rounding
in the fit's matrix-vector product would be amplified by the inverse's norm (10^3 at degree 10, 10^5 at 16), so that
product is compensated. What error is left moves only the ends of pieces, since signs at these ends (n + 1 samples, n
points) and the last refinement are of f itself (EVAL = 1). Two roots closer than the critical point between them is
known are missed, and so are touches, unless rounding makes them cross.

**Changes against the paper**
- Section 2.2 refines by bisection of f; here by Newton's steps kept in the bracket, with f's own value and the fit's
  slope, as the list that opens section 2 has it: 7 evaluations in all on the sphere instead of 23, the same error.
- A change of sign between samples bounds the first root from above, and only pieces before it are looked for.
- The nodes are symmetric, so sums and differences of opposite samples (error-free too) take half the products.
- Nodes are rounded first, and H inverted exactly for the rounded ones: no double-precision step.
- Newton's method starts where a cubic that is level at both ends would put it, not in the middle.
- BASIS = 1 finds roots in the Bernstein basis as well; the paper gives runtimes for the monomial basis only.

Evaluations counted are those of f; none of the fit's.

**Speed** Processor time on opencl:intel, float32, 1024 x 1024, szente's seven surfaces of Table 4: 3.1 (16-ball) to 69
(sphere) times less than ray_march, 24.6 in the mean (the paper: 23.6), against a ray_march that is itself 2.7 to 4.9
times faster than step by step. Of it EFT takes 6 to 16 % (on the 16-ball less than nothing: without it vectors
diverge), EVAL 17 % on the sphere and up to 5 % elsewhere; the levels of derivatives take two thirds at degree 6 and
four fifths at degree 10. Kept, and what each saves in the mean (at most): Newton instead of 22 bisections of f, 17 %
(42 % on the sphere); steps that may end on the bracket itself, without which one ray of a vector goes on halving, 12 %
(28 %); the sign of samples, 6 % (30 % on the 16-ball); the closed form of the linear level, 4 % (21 %); the start of
Newton's method, 4 % (8 %); to degree 4 the parabola's on end pieces (26 % on the sphere; for every level and degree it
costs 2 to 17 %); a sample's sign at the last end, 1 % (5 %). ISOLATION 2^-10 is as right as 2^-16 there, 2^-6 is not.
Rejected: Newton's method for all roots of a level at once, so that their chains overlap (2.5 times slower: its arrays
leave the registers); slopes from the next derivative's own coefficients (twice slower on calyx); unrolling by pragma
(no difference); Horner's scheme by fma (1.1 times faster on the octic, 0.87 on calyx).
"""

from collections.abc import Mapping
from typing import Literal

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
PRINTED = {"LAST": 0, "TOLERANCE": 2.0**-23, "START": 0, "SAMPLES": 0, "MATRIX": 0}


def _tables(surface: Surface, knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.fitting import derivative_factors, fit_tables, whole_tables

    assert surface.degree is not None
    basis: Literal["monomial", "bernstein"] = "bernstein" if knobs["BASIS"] == 1 else "monomial"
    tables = fit_tables(surface.degree, basis, precision) | whole_tables(surface.degree, basis, precision)
    return tables | {"FACTORS": derivative_factors(surface.degree, basis)}


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not algebraic: along a ray it is no polynomial, which the fit would have to be"
    if 1 <= surface.degree <= MAX_DEGREE:
        return None
    return f"degree {surface.degree}: the fit is for degrees 1 to {MAX_DEGREE}"


METHOD = Method(
    name="eft_yuksel",
    source="szente",
    needs=("surface_value",),
    libraries=("dual", "fit", "polynomial", "fit_samples", "fit_whole"),
    parameters=(
        Parameter("BASIS", 0, "0: monomial on [-1, 1], 1: Bernstein on [0, 1]"),
        Parameter("EFT", 1, "1: compensated fit, 0: plain products and sums"),
        Parameter("EVAL", 1, "1: signs and refinement from f itself, 0: from the fit"),
        Parameter(
            "TOLERANCE",
            2.0**-18,
            "last step of the root, or width of what bisection leaves, in the fit's variable",
            finer="down",
            sweep=(2.0**-8, 2.0**-12, 2.0**-22),
            per="2.0 * DOMAIN_RADIUS",
            printed=2.0**-23,
        ),
        Parameter("ISOLATION", 2.0**-10, "last Newton step of the derivatives' roots, in the fit's variable"),
        Parameter("LAST", 1, "the root's own refinement: 1: Newton's steps, 0: bisection", printed=0),
        Parameter("START", 1, "Newton's first x: 1: by a cubic that is level at both ends, 0: the middle", printed=0),
        Parameter("SAMPLES", 1, "1: nothing is looked for behind the samples' first change of sign", printed=0),
        Parameter("MATRIX", 1, "the fit's inverse matrix, 1: in symmetric halves, 0: whole", printed=0),
    ),
    settings={
        "no EFT": PRINTED | {"EFT": 0, "EVAL": 0},
        "EFT": PRINTED | {"EFT": 1, "EVAL": 0},
        "EVAL": PRINTED | {"EFT": 0, "EVAL": 1},
        "EFT + EVAL": PRINTED | {"EFT": 1, "EVAL": 1},
        "Bernstein": PRINTED | {"BASIS": 1},
    },
    claims=frozenset({"no_false_hit"}),
    accepts=_accepts,
    tables=_tables,
)
