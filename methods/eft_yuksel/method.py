"""A polynomial fit of f along the ray, Yuksel's isolation of its roots, and refinement on f itself.

The kernel samples f at n + 1 points of the ray, where n is f's degree, and computes the coefficients of the polynomial
through these samples. The roots of its derivative cut the ray into pieces on which f is monotone. In the first piece at
whose ends f differs in sign, bisection or Newton's method finds the root, with f's own values.

**Source** szente, section 2 (fit: section 2.1 and equation 1; roots: section 2.2); C. Yuksel, High-performance
polynomial root finding for graphics, 2022. Compensated products and sums: Ogita, Rump, Oishi 2005 (Dot2), with the
inverse matrix in two parts.

**Theory** Along the ray f is a polynomial of degree n, and n + 1 samples determine it. Between neighbouring critical
points it is monotone, so there is at most one root there, and there is one if f differs in sign at the two ends.
Critical points are the roots of the derivative. These lie between the critical points of the derivative, and so on down
to the derivative of degree 2, whose roots have a formula. The fit multiplies the samples by the inverse of H (equation
1). The norm of the inverse would amplify the rounding errors of this product, by 10^3 at degree 10 and 10^5 at degree
16, so the product is compensated. The error that remains moves only the ends of the pieces: the signs at these ends and
the last refinement come from f itself (EVAL = 1; n + 1 samples and n points). Two roots are missed if they lie closer
to each other than the error of the critical point between them. Touches are missed, unless rounding makes f cross
there.

**Changes against the paper** Each is a knob whose `printed` value is the paper's:
- LAST: section 2.2 ends with bisection of f itself to float32's precision: TOLERANCE = 2^-23, which takes 23
  evaluations on an interval of length 1. The default is Newton's method, kept in the bracket, with f's own value and
  the fit's slope, as step 3 of the list in section 2 and the authors' code have it. With EVAL = 0 the fit replaces f in
  either.
- START: Yuksel's Newton method starts in the middle of a piece. Ours starts where a cubic that is level at both ends of
  the piece has its root. To degree 4 it is a parabola that is level at one end on the first and the last piece.
- SAMPLES: a change of sign between samples is an upper bound of the first root, so only the pieces before it are
  searched. With EVAL = 0, a plain fit can contradict that sign, and then the root is lost: on the 16-ball 97 of 36,864
  rays are wrong with our SAMPLES and our MATRIX, 25 without SAMPLES, 78 without MATRIX, 9 without both.
- MATRIX: the paper multiplies by the whole inverse, computed in double precision for nodes that float32 then rounds.
  The nodes are symmetric, so the sums and differences of opposite samples (error-free too) need half the products. Ours
  are rounded first, and H is inverted exactly for the rounded nodes.
- The paper prints no tolerance of isolation; its code has one for all levels. Ours is ISOLATION, also in the paper's
  settings. Newton steps of the isolation may end on the bracket, as in the GPU form that the paper names (Peters et al.
  2023).
- BASIS: the paper prints no times for the Bernstein basis (BASIS = 1).

The kernel knows only the values of f and its degree, and every table depends on the degree only. So the coefficients of
f may change from frame to frame. As printed the method takes 2.2 times as long on the sphere and 1.8 times as long on
the torus as yuksel, which expands the coefficients from the formula.

**Evaluations counted** Evaluations of f; none of the fit's.

**Speed** Processor time on opencl:intel, float32, 256x256, on the seven surfaces of szente's Table 4 in the domains of
configs/szente-table4.toml. Against ray_march step by step the printed setting is 4.9 (16-ball) to 184 (torus) times as
fast, 95 in the mean. Against our ray_march in blocks it is 1.2 to 32 times as fast, 19 in the mean (the paper has
23.6), and with our best setting 33 times. Of the printed setting's time EFT takes 5 to 34 %, 19 % in the mean (the
paper: 24 %). EVAL takes 19 % on the sphere, and nothing above the noise elsewhere.

**What was tried** Processor time on opencl:intel, float32, 256x256, on the seven surfaces of szente's Table 4. A saving
is a share of the printed time, by this change alone. With any of the first five rows 99 of 100 hits err by less than
1e-6 of the radius.

    what was tried                                            measured                                        kept
    --------------------------------------------------------  ----------------------------------------------  ----
    LAST = 1: Newton's steps to the root                      saves 14 % in the mean, at most 43 % (sphere);  yes
                                                              nothing where the fit takes most of the time
    MATRIX = 1: the matrix in halves                          saves 13 % in the mean, at most 31 % (decic)    yes
    SAMPLES = 1: the samples' sign                            saves 5 % in the mean, at most 29 % (16-ball)   yes
    START = 1: Newton's start by a cubic                      saves 4 % in the mean, at most 13 %             yes
    all four                                                  saves 38 % in the mean, at most 63 %            yes
    the quadratic derivative's roots by formula, as Yuksel    saves 5 % in the mean, 25 % on the sextic       yes
      has it, over Newton's method from the linear one up
    ISOLATION = 2^-10                                         as right as 2^-16                               yes
    ISOLATION = 2^-6                                          not as right                                    no
    isolation's steps may end on the bracket itself           saves 12 % in the mean, at most 28 %: without   yes
                                                              it one ray of a vector goes on halving
    Newton's method for all roots of a level at once, so      2.5 times slower: its arrays leave the          no
      that their chains of operations overlap                 registers
    slopes from the next derivative's own coefficients        twice slower on calyx                           no
    unrolling by pragma                                       no difference                                   no
    Horner's scheme by fma                                    1.1 times faster on the octic, 0.87 on calyx    no
"""

from collections.abc import Mapping
from typing import Literal

from harness.contract import Method, Parameter, Precision, Surface
from harness.kernels.fitting import cannot_be_fitted

PRINTED = {"LAST": 0, "TOLERANCE": 2.0**-23, "START": 0, "SAMPLES": 0, "MATRIX": 0}


def _tables(surface: Surface, knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.fitting import derivative_factors, fit_tables, whole_tables

    assert surface.degree is not None
    basis: Literal["monomial", "bernstein"] = "bernstein" if knobs["BASIS"] == 1 else "monomial"
    tables = fit_tables(surface.degree, basis, precision) | whole_tables(surface.degree, basis, precision)
    return tables | {"FACTORS": derivative_factors(surface.degree, basis)}


METHOD = Method(
    name="eft_yuksel",
    source="szente",
    label="EFT Yuksel",
    needs=("surface_value",),
    libraries=("dual", "fit", "polynomial", "fit_samples", "fit_whole"),
    parameters=(
        Parameter("BASIS", 0, "basis of the fit; 0: monomials on [-1, 1]; 1: Bernstein on [0, 1]"),
        Parameter("EFT", 1, "products and sums of the fit; 1: compensated by error-free transforms; 0: plain"),
        Parameter("EVAL", 1, "signs at the ends of pieces and the last refinement come from; 1: f itself; 0: the fit"),
        Parameter(
            "TOLERANCE",
            2.0**-18,
            "last Newton step of the root, or the interval that bisection leaves, over half the ray's "
            "length in the domain (BASIS 0) or all of it (BASIS 1)",
            finer="down",
            sweep=(2.0**-8, 2.0**-12, 2.0**-22),
            per="2.0 * DOMAIN_RADIUS",
            printed=2.0**-23,
        ),
        Parameter(
            "ISOLATION", 2.0**-10, "last Newton step of the roots of derivatives, over the same length as TOLERANCE"
        ),
        Parameter("LAST", 1, "refinement of the root itself; 1: Newton's method; 0: bisection", printed=0),
        Parameter(
            "START",
            1,
            "where Newton's method starts in a piece; 1: at the root of a cubic that is level at both "
            "ends; 0: in the middle",
            printed=0,
        ),
        Parameter(
            "SAMPLES",
            1,
            "1: pieces behind the first sign change between samples are not searched; 0: all are",
            printed=0,
        ),
        Parameter(
            "MATRIX",
            1,
            "how the fit multiplies by its inverse matrix; 1: in two symmetric halves; 0: by the whole matrix",
            printed=0,
        ),
    ),
    settings={
        "no EFT": PRINTED | {"EFT": 0, "EVAL": 0},
        "EFT": PRINTED | {"EFT": 1, "EVAL": 0},
        "EVAL": PRINTED | {"EFT": 0, "EVAL": 1},
        "EFT + EVAL": PRINTED | {"EFT": 1, "EVAL": 1},
        "Bernstein": PRINTED | {"BASIS": 1},
    },
    claims=frozenset({"no_false_hit"}),
    accepts=cannot_be_fitted,
    tables=_tables,
)
