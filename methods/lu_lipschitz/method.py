"""Lipschitz tracing along the ray by LU or control-point bounds of the fitted derivative.

The kernel fits f along the ray by a polynomial in Bernstein form, and bounds the slope of f from the coefficients of
its derivative. It then marches from the near end. A step is |f| over that bound, or TOLERANCE if that is longer; only
the latter can pass a root. When f has changed its sign, one secant step gives the hit.

**Source** szente, section 3 (equations 2 and 5 to 8) and Table 5; the fit of section 2.1, in the Bernstein basis.

**Theory** Where f falls towards 0 by no more than L per unit of length, it has no root within |f| / L, so a step of
this length passes none. Let f be positive at the ray's start (otherwise -f is used). Then -L is a lower bound of the
derivative of the fitted polynomial. There are two such bounds: the least control point (equation 2, BOUND = 0), and the
minimum of the lower LU function (equation 5, BOUND = 1). The LU function lies nowhere above the derivative, and its
minimum is known in closed form (equation 8). Where the same kind of bound keeps f itself away from 0 on the whole ray,
the ray is a miss at once (CULL = 1). The shortest step is TOLERANCE. Such a step passes the root at last, so two roots
that are closer to each other than TOLERANCE can be missed. So it is, by default, the least step by which t surely moves
on: 4 unit roundoffs of the ray's length, in either precision. On the families of hard rays (`firsthit run
configs/stability.toml`) the method then holds 17 of the 20 families that float32 can decide, and all 20 in float64.
With 2^-16 it held 12 and 14.

**Changes against the paper**
- LOCAL: the paper uses one bound for the whole ray (LOCAL = 0). Its section 3 ends with the remark that a curve whose
  extremum lies outside [a, b] has it at an end of [a, b] on that interval; the paper leaves this for later. LOCAL = 2
  does it, on the window of the next step. LOCAL = 1 (default) is ours: de Casteljau's algorithm restricts the
  coefficients to that window, and these are bounded. (With LOCAL = 2 the interior control points still belong to the
  whole ray.) The window is twice as long as the last step, so that steps near a root become Newton's.
- The root in equation 8 has the exponent 1/(n - 1), as printed, and where the least control point is at an end the
  extremum is there. The authors' published code takes 1/n, which gives no bound.
- CULL: the paper culls rays by LU bounds. It does not say whether control points cull too; in the setting "control
  point" they do not.
- SIDES: until its first root f keeps its sign, so only the slope towards 0 counts (SIDES = 1). The paper takes the
  larger magnitude of both slopes.
- MATRIX: as in eft_yuksel.
- TRUST: the bounds are widened by the error that their coefficients can have; the paper widens nothing (TRUST = 0).
  This has two parts. The first is f's rounding errors in the samples (harness/kernels/rounding.py, as in bernstein),
  times what the fit makes of them on a piece as long as the window (GROWTH, SLOPE_GROWTH). The second is the rounding
  errors of the fit and of de Casteljau's algorithm. Of f's rounding errors the share TRUST of the worst case is
  counted. TRUST is 1/16; the largest error seen on random rays was 1/26 of the worst case. So the claim
  conservative_bound holds for rounding errors up to that share, and for all steps but the shortest one.
  tests/test_error_bounds.py checks the stated bounds against exact coefficients. The value of f at each step is taken
  as computed, so a pair of roots between which |f| stays below its own rounding errors can be passed.
- The paper gives no shortest step and does not say what counts as a hit. Here a change of sign does, never a small |f|,
  so that near misses do not become hits. A secant step then ends the search. The authors' code takes the tolerance
  1e-5, to which the 2^-16 of the printed settings is near, and steps that are 1.6 times as long as the bound allows;
  the paper prints no such factor.
- Degrees 1 to 20 are accepted. The paper stops at 6, where its steps run out.

**Evaluations counted** Evaluations of f.

**What true bounds cost** With TOLERANCE = 2^-16, TRUST = 1/16 is compared with a plain allowance of 8 n unit roundoffs
of the largest coefficient, where n is the degree. The allowance is no bound: on most rays of high degree the samples'
rounding errors exceed it. float32, azimuth 30° and elevation 35°. Evaluations a ray are at 96x96. Times are those with
TRUST over those with the allowance, both measured in one run by turns. With TRUST = 1 the octic takes 600 evaluations a
ray. In float64 nothing changes.

    surface        evaluations, TRUST  evaluations, allowance  time, opencl:intel  time, opengl:llvmpipe
    -------------  ------------------  ----------------------  ------------------  ---------------------
    torus          5.88                5.87                    1.0                 -
    Barth sextic   10.96               10.95                   -                   -
    Endraß octic   18.7                15.3                    1.4                 1.7
    16-ball        24.8                22.0                    1.3                 1.4

**Speed** Processor time on opencl:intel, float32, 256x256, TOLERANCE = 2^-16, on the four surfaces of szente's Table 5
in the domains of configs/szente-table5.toml. As printed, LU bounds are 1.05 times as fast as control points in the mean
(the paper: 1.37). All of this is from culling the sphere's misses: without culling it is 0.99. The printed setting is
33 times as fast as ray_march step by step (the paper: 7), and 6.0 times as fast as ray_march in blocks. LOCAL = 2 takes
fewer evaluations than the printed setting on all four surfaces, but computes the powers of two curves for each of them.

    ratio                                          mean  sphere  flirt  calyx  Barth sextic
    ---------------------------------------------  ----  ------  -----  -----  ------------
    speed of LU bounds over control points         1.05  1.24    1.00   0.97   1.00
    speed over ray_march in blocks                 6.0   13.7    3.9    5.1    1.5
    time with SIDES = 1, over printed              0.85  1.00    0.74   0.87   0.78
    time with LOCAL = 1, over printed              0.36  0.58    0.30   0.43   0.14
    time with MATRIX = 1, over printed             0.99  -       -      -      -
    time with TRUST = 1/16, over printed           1.00  -       -      -      -
    time with all four of these, over printed      0.29  -       -      -      -
    time with LOCAL = 2, over printed              -     0.47    1.24   1.58   1.74
    evaluations a ray, printed                     -     17      60     60     201
    evaluations a ray with LOCAL = 2               -     6.6     42     52     181

**What was tried** Processor time on opencl:intel, float32, 256x256, on the four surfaces of szente's Table 5.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    control points, with LOCAL = 1 and culling              faster still: in a small window the closed form     no
                                                            costs more than its bound gains. LU bounds stay
                                                            the default, as this is the LU method
    equation 8's root by Halley's iteration that ends when  pow takes 1.2 times as long in all with LOCAL = 1;  yes
      it has converged, over the language's pow             in the printed setting it takes as long
    starting where the LU function of f reaches 0, by       factor 1.2 on the sphere, within 5 % elsewhere,     no
      Newton's method on a convex curve                     for 20 more lines
    shortest steps of 2^-16 of the ray                      0.97 times the evaluations (the mean of 18          no
                                                            surfaces) and 1.2 times the error that 999 of 1000
                                                            rays stay below (octic: 0.6 times). Time at
                                                            512x512: 0.42 times on the heart, 0.78 on octic
                                                            and decic, 0.93 to 0.99 on the torus, Kummer's
                                                            surface, calyx, Barth sextic and 16-ball. But 12
                                                            and 14 families of hard rays are held (float32 and
                                                            float64), not 17 and 20
    shortest steps of 8 unit roundoffs                      0.8 to 0.97 times the time; of the families that 4  no
                                                            roundoffs hold, clustered roots are lost
    steps of (|f| + its error bound) over the slope's       of 7 families 1 is held, in place of 6: even 1/256  no
      bound, in place of a shortest one                     of that bound is so large that pairs are passed
    windows of 1.5, 3 or 4 times the last step              as many evaluations                                 no
    bisections after the change of sign                     4 of 12 evaluations, no better error                no
"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface
from harness.kernels.fitting import cannot_be_fitted

PRINTED = {"SIDES": 2, "LOCAL": 0, "TOLERANCE": 2.0**-16, "TRUST": 0.0, "MATRIX": 0}
SHELLS = 16  # balls about the domain's centre, each with its own bound of f's rounding errors
DEPTHS = 6  # halvings for which the tables say how errors grow; further ones change nothing
COORDINATES = 6.0  # error of a point's coordinates, in unit roundoffs of its distance from the centre


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


METHOD = Method(
    name="lu_lipschitz",
    source="szente",
    label="LU Lipschitz",
    needs=("surface_value",),
    libraries=("interval", "dual", "fit", "polynomial", "lu", "fit_samples", "fit_whole"),
    parameters=(
        Parameter("BOUND", 1, "what bounds the slope and f; 1: the LU function; 0: control points"),
        Parameter(
            "SIDES", 1, "slope that bounds a step; 1: the one towards zero; 2: the larger magnitude of both", printed=2
        ),
        Parameter("CULL", 1, "1: a ray on which the bound keeps f away from zero is a miss at once; 0: it is marched"),
        Parameter(
            "LOCAL",
            1,
            "what a step is bounded by; 0: one bound for the whole ray; 1: coefficients restricted to the "
            "next window; 2: the whole ray's curve on the next window",
            printed=0,
        ),
        Parameter(
            "TOLERANCE",
            2.0**-51,
            "shortest step, over the ray's length in the domain; never less than 4 unit roundoffs",
            finer="down",
            sweep=(2.0**-10, 2.0**-13, 2.0**-16),
            per="2.0 * DOMAIN_RADIUS",
            printed=2.0**-16,
        ),
        Parameter(
            "TRUST",
            0.0625,
            "share of the worst case of f's rounding errors by which bounds are moved; 0: neither these "
            "nor the fit's count",
            printed=0.0,
        ),
        Parameter(
            "MATRIX",
            1,
            "how the fit multiplies by its inverse matrix; 1: in two symmetric halves; 0: by the whole matrix",
            printed=0,
        ),
        Parameter("MAX_EVALUATIONS", 10000, "evaluations of f on one ray, after which the ray is exhausted"),
    ),
    settings={
        "LU bound": PRINTED | {"BOUND": 1, "CULL": 1},
        "control point": PRINTED | {"BOUND": 0, "CULL": 0},
        "LU bound on subintervals": PRINTED | {"BOUND": 1, "CULL": 1, "LOCAL": 2},
    },
    claims=frozenset({"conservative_bound", "no_false_hit"}),
    accepts=cannot_be_fitted,
    tables=_tables,
)
