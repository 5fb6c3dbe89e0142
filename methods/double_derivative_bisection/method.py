"""Bisection of f along the ray; where f does not change sign, bisection of its derivative finds the extreme.

The kernel splits the ray's interval in the domain into pieces and searches them from the nearest on. It halves a piece
ITERATIONS times. While f has the same sign at both ends, the sign of the derivative f' chooses the half; as soon as f
has another sign at a midpoint, the sign of f chooses it.

**Source** toledo2007, section 4.2 (equation 3 and Figure 3).

**Theory** Assume that f has one sign at both ends of a piece, and one extreme in it that points towards 0. Halving by
the sign of f' converges to this extreme. If f changes sign on the way there, halving goes on by the sign of f and finds
the first root. Along a ray a quartic with leading coefficient a > 0 falls, rises, falls and rises again at most, so it
has at most two minima and a maximum between them. The root of its third derivative, t_M = -b/(4a) (equation 3, with a =
1 there), is the mean of the three extremes, so it lies between the outer two: it separates the two minima.

**Changes against the paper**
- SPLIT: t_M separates the minima, but it can lie behind the maximum between them. Then f falls, rises and falls again
  on the piece before t_M. The paper's argument covers no such piece, and halving may find a later root. On Table 1's
  six views no ray is lost by this; at other elevations of the torus up to 2 of 16,384 are, and on the spindle torus,
  from all sides, 8 of 9,216. With SPLIT = 1 (default) three pieces are searched, separated where f'' changes sign. f is
  convex on the outer two pieces and concave on the middle one, so the paper's argument covers each of them, and a piece
  in which the slopes at its ends rule out a root is skipped.
- SPLIT = 0 splits at t_M only, as printed, and halves every piece that is not empty: slopes at the ends rule out
  nothing there. (On a piece on which f falls, rises and falls again they would lose the first root: 130 rays of Table
  1's view at 72°.)
- Where f has one sign at both ends, the paper halves by "the sign of derivatives". We read this so: where f' points
  towards the other sign of f, the extreme lies ahead.
- ITERATIONS: the paper prints its error, 0.0014 r, but not how often it halves. The printed setting takes 12 here, with
  which the error on Table 1's views is 4.4e-4 r. 11 would be enough (8.8e-4 r), but they take opencl:intel 1.4 times as
  long. The default is larger, 22.
- Any quartic is accepted whose leading coefficient is positive along every ray. The paper's is the torus.
- Rays begin at their point nearest the domain's centre (`origins` of a config). The paper's rays begin at the box, and
  configs for its tables do the same. Of 24,576 rays of Table 1's views (opencl:pocl, float32) the printed setting gets
  none wrong from the nearest point, none wrong from the box, and 52 wrong from the eye. Its largest error is 4.3e-4 r,
  4.3e-4 r and 3.4e-2 r.

**Evaluations counted** One for each point, at which f and its derivative are evaluated together.

**What was tried** float32, torus, azimuth 30° and elevation 35°; processor time above the null method's, measured by
turns.

    what was tried                                            measured                                        kept
    --------------------------------------------------------  ----------------------------------------------  ----
    22 halvings of three pieces, over 22 of the printed two   0.87 times the time, on opencl:intel and on     yes
                                                              opencl:pocl: pieces that hold no root by their
                                                              end slopes are skipped
    12 halvings, over 22                                      0.55 times the time                             -
"""

from functools import lru_cache
from itertools import product

from harness.contract import Method, Parameter, Surface

PIECES = 16  # parts of a side of a cube's face, in each direction


@lru_cache(maxsize=128)
def leads_positively(surface: Surface) -> bool:
    """Return whether f's terms of degree 4 are proved positive in every direction d, so that f(o + t d) has a > 0."""
    import flint

    from surfaces import tape_of
    from surfaces.lowering import coefficients_along, real_tape
    from surfaces.numbers import Balls
    from surfaces.tape import walk

    tape = coefficients_along(real_tape(tape_of(surface)), 4)
    origin = dict.fromkeys(("ox", "oy", "oz"), flint.arb(0))
    steps = [flint.arb((2 * i + 1) / PIECES - 1, 1 / PIECES) for i in range(PIECES)]
    for one, u, v in product(range(3), steps, steps):
        direction = [u, v]
        direction.insert(one, flint.arb(1))
        leading = walk(tape, Balls(), origin | dict(zip(("dx", "dy", "dz"), direction, strict=True)))[4]
        if not leading > 0:
            return False
    return True


def accepts(surface: Surface) -> str | None:
    """Say why the surface is refused; None for a quartic whose leading coefficient is positive along every ray."""
    if surface.degree != 4:
        return "no quartic"
    return None if leads_positively(surface) else "its leading coefficient is not positive along every ray"


METHOD = Method(
    name="double_derivative_bisection",
    source="toledo2007",
    needs=("surface_along", "surface_dual_along"),
    parameters=(
        Parameter(
            "ITERATIONS",
            22,
            "halvings of each piece of the ray",
            finer="up",
            sweep=(12, 16, 30),
            per="2.0 * DOMAIN_RADIUS",
            printed=12,
        ),
        Parameter(
            "SPLIT",
            1,
            "where the ray is split into pieces; 1: at the roots of f'' (three pieces); 0: at t_M, the "
            "root of f''' (two)",
            printed=0,
        ),
    ),
    claims=frozenset({"no_false_hit", "error_below_tolerance"}),
    tolerance=lambda surface, knobs: 2.0 * surface.domain.radius * 0.5 ** (knobs["ITERATIONS"] + 1),
    settings={"D.D. Bisection": {"ITERATIONS": 12, "SPLIT": 0}},
    accepts=accepts,
)
