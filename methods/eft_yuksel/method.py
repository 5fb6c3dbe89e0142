"""Polynomial fit along the ray by error-free transforms; Yuksel's bracketing; refinement on the original function.

**Source** szente, section 2 (fit: 2.1, equation 1; roots: 2.2); C. Yuksel, High-performance polynomial root finding
for graphics, 2022. Products and sums: Ogita, Rump, Oishi 2005 (Dot2), with the inverse matrix in two parts.

**Theory** f along the ray is a polynomial of f's degree n, known from n + 1 samples. Between neighbouring critical
points it is monotone, so one root at most lies there, where the ends differ in sign. Critical points are the roots of
the derivative, themselves between the derivative's critical points, and so on, from the quadratic derivative up.
Rounding in the fit's matrix-vector product would be amplified by the inverse's norm (10^3 at degree 10, 10^5 at 16), so
that product is compensated. What error is left moves only the ends of pieces, since signs at these ends (n + 1 samples,
n points) and the last refinement are of f itself (EVAL = 1). Two roots closer than the critical point between them is
known are missed, and so are touches, unless rounding makes them cross.

**Changes against the paper**, each a knob whose `printed` value is the paper's:
- LAST: section 2.2 ends with bisection of f itself, to float32's precision (TOLERANCE 2^-23: 23 evaluations of an
  interval of length 1). Ours are Newton's steps kept in the bracket, with f's own value and the fit's slope, as the
  list that opens section 2 and the authors' code have it. With EVAL = 0 the fit stands for f in either.
- START: Yuksel's Newton method starts in a piece's middle. Ours starts where a cubic that is level at both ends has its
  root, or on the first and last piece to degree 4 the parabola that is level at one.
- SAMPLES: a change of sign between samples bounds the first root from above, and only pieces before it are looked for.
  With EVAL = 0 a plain fit that contradicts that sign then loses the root: 97 wrong rays of 36,864 on the 16-ball with
  both our SAMPLES and our MATRIX, 25 without SAMPLES, 78 without MATRIX, 9 without either.
- MATRIX: the paper multiplies with the whole inverse, made in double precision for nodes that float32 rounds. Nodes lie
  symmetrically, so sums and differences of opposite samples (error-free too) take half the products; and ours are
  rounded first, and H is inverted exactly for the rounded ones.
- The paper gives no tolerance of isolation (its code has one for all levels): ours, ISOLATION, is in its settings too.
  Steps of isolation may end on the bracket, as the GPU form that the paper names has them (Peters et al. 2023).
- The paper has no runtimes for BASIS = 1.

f is a black box: the kernel is told its values and its degree alone, and every table depends on the degree alone, so
coefficients may change from frame to frame. As printed it takes 2.2 times as long on the sphere and 1.8 times as long
on the torus as yuksel, which expands the coefficients from the formula.

Evaluations counted are those of f; none of the fit's.

**Speed** Processor time on opencl:intel, float32, 256 x 256, szente's seven surfaces of Table 4 in the domains of
configs/szente-table4.toml. As printed it is 4.9 (16-ball) to 184 (torus) times faster than ray_march step by step, 95
in the mean, and 1.2 to 32 times, 19 in the mean, faster than our march in blocks (the paper: 23.6); at our best 33
times. Of the printed time EFT takes 5 to 34 %, 19 in the mean (the paper: 24); EVAL 19 % on the sphere and nothing
beyond noise elsewhere. What each change saves alone, in the mean (at most): Newton's steps to the root 14 % (43 %,
sphere), and where it is the fit that takes the time, nothing; the matrix in halves 13 % (31 %, decic); the samples'
sign 5 % (29 %, 16-ball); the start 4 % (13 %); all four 38 % (63 %). With any of them 99 of 100 hits err by less than
1e-6 of the radius. The quadratic derivative by formula, as Yuksel has it, saved 5 % against Newton's method from the
linear one up (25 % on the sextic). ISOLATION 2^-10 is as right as 2^-16 there, 2^-6 is not. Kept: steps that may end on
the bracket itself, without which one ray of a vector goes on halving, 12 % (28 %). Rejected: Newton's method for all
roots of a level at once, so that their chains overlap (2.5 times slower: its arrays leave the registers); slopes from
the next derivative's own coefficients (twice slower on calyx); unrolling by pragma (no difference); Horner's scheme by
fma (1.1 times faster on the octic, 0.87 on calyx).
"""

from collections.abc import Mapping
from typing import Literal

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
PRINTED = {"LAST": 0, "TOLERANCE": 2.0**-23, "START": 0, "SAMPLES": 0, "MATRIX": 0}


def _tables(surface: Surface, knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.fitting import derivative_factors, fit_tables, whole_tables

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
