"""Lipschitz tracing along the ray, by LU or control-point bounds of the fitted derivative.

**Source** szente, section 3 (equations 2 and 5 to 8) and Table 5; fit as in section 2.1, in the Bernstein basis.

**Theory** Where f nears zero no faster than L, it has no root within |f| / L: a step that long misses none. L is the
bound of the derivative's fitted polynomial, from its control points (BOUND = 0) or from the LU function, which is
nowhere above the polynomial and whose least value is known in closed form (BOUND = 1). Where the same bound keeps f
itself from zero, the ray is a miss at once (CULL = 1). A root is passed at last by the shortest step, TOLERANCE, and
one secant step ends the search; two roots closer than that can be missed.

**Changes against the paper**
- LOCAL: printed, one bound for the whole ray (0). Section 3 ends with the remark that a curve whose extremum is not in
  [a, b] has it at an end, which the paper leaves for later: LOCAL = 2 is that, on the interval of the next step. Ours
  (1) bounds the coefficients that de Casteljau's algorithm restricts to that interval, since with LOCAL = 2 interior
  control points still stem from the whole one. The interval is twice the last step, so that steps near a root become
  Newton's.
- The exponent of Equation 8's root is 1/(n - 1), and where an end is the least control point the extremum is there
  (the published code takes 1/n, which is not a bound).
- CULL: LU bounds cull in the paper. Whether its control points do is not said; in the setting "control point" they do
  not.
- SIDES: until its first root f keeps its sign, so only the slope towards zero counts; the paper takes the magnitude.
- MATRIX: as eft_yuksel's.
- TRUST: bounds are moved by what their coefficients may be off by (printed, 0: by nothing): f's own roundings in the
  samples (harness/kernels/rounding.py, as bernstein has them), times what the fit makes of them on a piece as long as
  the window (GROWTH, SLOPE_GROWTH), and the roundings of the fit and of de Casteljau's algorithm. Of f's own roundings
  TRUST of the worst case is reckoned with: 1/16, where the largest seen on random rays is 1/26 of it.
  tests/test_error_bounds.py holds the stated bounds against exact coefficients. The steps' own f is taken as computed,
  so a pair of roots between which f does not leave its roundings can be passed.
- The paper gives neither a shortest step nor how a hit is told. Here a change of sign is one, never a small |f|, so
  that near misses do not become hits, and a secant step ends the search. Its code takes 1e-5, and steps that are 1.6
  times as long as the bound allows; the paper prints no such factor.
- Accepts degree 1 to 20; the paper stops at 6, where its steps run out.

Evaluations counted are those of f.

**What true bounds cost** (float32, 30°/35°, against 8 n roundoffs of the largest coefficient, which the rounding of the
samples exceeds on most rays of high degree.) Evaluations a ray at 96x96: torus 5.88 (5.87), Barth sextic 10.96 (10.95),
Endraß octic 18.7 (15.3), 16-ball 24.8 (22.0); with TRUST = 1 the octic takes 600. Time on opencl:intel, both in one run
by turns: torus 1.0, octic 1.4, 16-ball 1.3; on opengl:llvmpipe the octic 1.7, the 16-ball 1.4. In float64 nothing
changes.

**Speed** Processor time on opencl:intel, float32, 256 x 256, szente's four surfaces of Table 5 (sphere, flirt, calyx,
Barth sextic) in the domains of configs/szente-table5.toml. As printed, LU bounds over control points: 1.05 in the mean
(1.24, 1.00, 0.97, 1.00; the paper: 1.37), all of it from culling the sphere's misses, and 0.99 without culling. Over
ray_march, step by step 33 (the paper: 7), in blocks 6.0 (13.7, 3.9, 5.1, 1.5). What each change of ours makes of the
printed time: SIDES 0.85 (1.00, 0.74, 0.87, 0.78), LOCAL = 1 0.36 (0.58, 0.30, 0.43, 0.14), MATRIX 0.99, TRUST 1.00; all
of them 0.29. LOCAL = 2, the paper's remark, takes fewer evaluations everywhere (6.6, 42, 52 and 181 a ray instead of
17, 60, 60 and 201) but two curves' powers at each: 0.47 on the sphere, and 1.24, 1.58, 1.74. Control points with LOCAL
= 1 and culling are faster still, since in a small window the closed form costs more than its bound gains; BOUND = 1
stays the default, as this is the LU method. Kept: Equation 8's root by Halley's iteration that ends when it has
converged; the language's `pow` takes 1.2 times as long in all with LOCAL = 1, and as long as printed. Rejected:
starting where the LU function of f reaches zero (Newton's method on a convex curve: 1.2 on the sphere, within 5 %
elsewhere, for 20 more lines); windows of 1.5, 3 or 4 times the last step (as many evaluations); bisections after the
change of sign (4 of 12 evaluations, no better error).
"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
PRINTED = {"SIDES": 2, "LOCAL": 0, "TRUST": 0.0, "MATRIX": 0}
SHELLS = 16  # balls with a bound of f's roundings of their own
DEPTHS = 6  # halvings whose growth of errors is tabulated; it falls no further
COORDINATES = 6.0  # unit roundoffs of a point's distance from the centre by which its coordinates may be off


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.fitting import fit_tables, whole_tables
    from harness.kernels.rounding import sample_errors_grow, slope_errors_grow, value_errors

    assert surface.degree is not None
    fit = fit_tables(surface.degree, "bernstein", precision) | whole_tables(surface.degree, "bernstein", precision)
    return fit | {
        "VALUE_ERRORS": list(value_errors(surface, SHELLS, COORDINATES)),
        "GROWTH": sample_errors_grow(surface.degree, precision, 0),
        "SLOPE_GROWTH": slope_errors_grow(surface.degree, precision, DEPTHS),
    }


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not algebraic: along a ray it is no polynomial, whose derivative the bounds are of"
    if 1 <= surface.degree <= MAX_DEGREE:
        return None
    return f"degree {surface.degree}: the fit is for degrees 1 to {MAX_DEGREE}"


METHOD = Method(
    name="lu_lipschitz",
    source="szente",
    needs=("surface_value",),
    libraries=("interval", "dual", "fit", "polynomial", "lu", "fit_samples", "fit_whole"),
    parameters=(
        Parameter("BOUND", 1, "1: LU bounds, 0: control points"),
        Parameter("SIDES", 1, "1: the slope towards zero counts, 2: the larger of both slopes' magnitudes", printed=2),
        Parameter("CULL", 1, "1: rays whose f is bounded away from zero end at once"),
        Parameter(
            "LOCAL",
            1,
            "0: one bound for the whole ray, 1: of the coefficients on the next window, 2: of the ray's curve on it",
            printed=0,
        ),
        Parameter(
            "TOLERANCE",
            2.0**-16,
            "shortest step, over the ray's length in the domain",
            finer="down",
            sweep=(2.0**-10, 2.0**-13, 2.0**-20),
            per="2.0 * DOMAIN_RADIUS",
        ),
        Parameter(
            "TRUST",
            0.0625,
            "share of the worst case of f's roundings that is reckoned with; 0: no roundings are, the fit's neither",
            printed=0.0,
        ),
        Parameter("MATRIX", 1, "the fit's inverse matrix, 1: in symmetric halves, 0: whole", printed=0),
        Parameter("MAX_EVALUATIONS", 10000, "evaluations spent on one ray"),
    ),
    settings={
        "LU bound": PRINTED | {"BOUND": 1, "CULL": 1},
        "control point": PRINTED | {"BOUND": 0, "CULL": 0},
        "LU bound on subintervals": PRINTED | {"BOUND": 1, "CULL": 1, "LOCAL": 2},
    },
    claims=frozenset({"conservative_bound", "no_false_hit"}),
    accepts=_accepts,
    tables=_tables,
)
