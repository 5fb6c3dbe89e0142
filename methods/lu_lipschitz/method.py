"""Lipschitz tracing along the ray, by LU or control-point bounds of the fitted derivative.

**Source** szente, section 3 (equations 2 and 5 to 8) and Table 5; fit as in section 2.1, in the Bernstein basis.

**Theory** Where f nears zero no faster than L, it has no root within |f| / L: a step that long misses none. L is the
bound of the derivative's fitted polynomial, from its control points (BOUND = 0) or from the LU function, which is
nowhere above the polynomial and whose least value is known in closed form (BOUND = 1). Where the same bound keeps f
itself from zero, the ray is a miss at once (CULL = 1). A root is passed at last by the shortest step, TOLERANCE, and
one secant step ends the search; two roots closer than that can be missed.

**Changes against the paper**
- LOCAL = 1, the paper's future work: the bound is of the derivative on the next window only, to which de Casteljau's
  algorithm restricts its coefficients; the window is twice the last step, so that steps near a root become Newton's.
  The LU function itself also adapts to a subinterval, as section 3 ends, but its interior control points still stem
  from the whole interval: tried first, it took 28 to 90 evaluations where this takes 9 to 11, and 30 to 100 without.
- The exponent of Equation 8's root is 1/(n - 1), and where an end is the least control point the extremum is there
  (the published code takes 1/n, which is not a bound).
- The bound is one-sided: until its first root f keeps its sign, so only the slope towards zero counts.
- Bounds are moved by what their coefficients may be off by: f's own roundings in the samples (harness/rounding.py, as
  bernstein has them), times what the fit makes of them on a piece as long as the window (GROWTH, SLOPE_GROWTH), and the
  roundings of the fit and of de Casteljau's algorithm. Of f's own roundings TRUST of the worst case is reckoned with:
  1/16, where the largest seen on random rays is 1/26 of it. tests/test_error_bounds.py holds the stated bounds against
  exact coefficients. The steps' own f is taken as computed, so a pair of roots between which f does not leave its
  roundings can be passed.
- The paper gives neither a shortest step nor how a hit is told; here a change of sign is one, never a small |f|, so
  that near misses do not become hits.
- Accepts degree 1 to 20; the paper stops at 6, where its steps run out.

Evaluations counted are those of f.

**What true bounds cost** (float32, 30°/35°, against 8 n roundoffs of the largest coefficient, which the rounding of the
samples exceeds on most rays of high degree.) Evaluations a ray at 96x96: torus 5.88 (5.87), Barth sextic 10.96 (10.95),
Endraß octic 18.7 (15.3), 16-ball 24.8 (22.0); with TRUST = 1 the octic takes 600. Time on opencl:intel, both in one run
by turns: torus 1.0, octic 1.4, 16-ball 1.3; on opengl:llvmpipe the octic 1.7, the 16-ball 1.4. The printed settings,
LOCAL = 0, take as long as before. In float64 nothing changes.

**Speed** These figures were taken before the bounds counted all roundings. Processor time on opencl:intel, float32,
szente's four surfaces of Table 5 (sphere, flirt, calyx, Barth sextic), over control points as the paper has them (SIDES
2: the largest magnitude; LOCAL 0, no culling). LU bounds with SIDES 2: 1.02 in the mean, nearly all of it from culling
the sphere's misses (1.17, 0.96, 0.97, 1.00), and 0.98 without culling. LU bounds of one side, against control points by
magnitude: 1.14 (1.15, 0.99, 1.12, 1.29), but control points of one side come to 1.12. The paper's 1.37 comes out by
neither reading. LOCAL = 1: 4.1 (1.9, 2.3, 2.6, 9.7). Control points with LOCAL = 1 and culling: 6.5, since in a small
window the closed form costs more than its bound gains; BOUND = 1 stays the default, as this is the LU method. Kept:
ending the root's iteration when it has converged (1.3). Rejected: starting where the LU function of f reaches zero
(Newton's method on a convex curve: 1.2 on the sphere, within 5 % elsewhere, for 20 more lines); windows of 1.5, 3 or 4
times the last step (as many evaluations); bisections after the change of sign (4 of 12 evaluations, no better error).
"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
PRINTED = {"SIDES": 2, "LOCAL": 0, "TRUST": 0.0, "MATRIX": 0}
SHELLS = 16  # balls with a bound of f's roundings of their own
DEPTHS = 6  # halvings whose growth of errors is tabulated; it falls no further
COORDINATES = 6.0  # unit roundoffs of a point's distance from the centre by which its coordinates may be off


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.fitting import fit_tables, whole_tables
    from harness.rounding import sample_errors_grow, slope_errors_grow, value_errors

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
        Parameter("MATRIX", 1, "the fit's matrix 1: in symmetric halves, 0: whole", printed=0),
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
