"""Bisection on f and, where f does not change sign, on its derivative; once on each side of t_M = -b/(4a).

**Source** toledo2007, section 4.2 (equation 3 and Figure 3).

**Theory** Between two ends where f has one sign, with one extreme towards 0 between them, halving by the sign of f'
comes down on the extreme; where f changes sign on the way there, halving goes on by the sign of f and finds the first
root. A quartic with a > 0 falls, rises, falls and rises again at most. The root of its third derivative, t_M, is the
mean of its three extremes and so lies between the outer two: it parts the two minima.

**Changes against the paper**
- t_M parts the minima but can lie past the maximum between them; then its left side falls, rises and falls again, and
  neither situation of the paper is at hand: halving may come down on a later root. Of Table 1's six views no ray is
  lost so; at other elevations of the torus up to 2 of 16,384, on the spindle torus from all sides 8 of 9,216. SPLIT
  = 1 searches three pieces, parted where f'' changes sign: f is convex on the outer two and concave between them, so
  one of the situations is always at hand, and a piece whose end slopes rule a root out is left before its loop.
  SPLIT = 0 parts at t_M only, as printed, and halves every piece that is not empty: there end slopes rule nothing out
  (on a piece that falls, rises and falls again they would drop the first root: 130 rays at Table 1's 72°).
- Where f has one sign at both ends, the paper halves by "the sign of derivatives". We read: where f' leads towards the
  other sign of f, the extreme is ahead.
- The paper prints its error, 0.0014 r, and not how often it halves: 12 times here, which keep 4.4e-4 r over Table 1's
  views. 11 would do (8.8e-4 r), but take opencl:intel 1.4 times as long. ITERATIONS is more by default, see `variants`.
- Any quartic whose leading coefficient is positive along every ray is accepted; the paper's is the torus.
- Rays begin at their point nearest the domain's centre (the axis `origins`), the paper's at the box, where its tables
  are run here. Of 24,576 rays of Table 1's views (opencl:pocl, float32) the printed setting gets none wrong from
  either, and 52 from the eye; its largest error is 4.3e-4 r, 4.3e-4 r and 3.4e-2 r.

One evaluation of f with its derivative is counted for each point.

**Speed** (float32, torus, 30°/35°, processor time above the null method's, in turns.) 22 halvings of three pieces take
0.87 times as long as of the printed two, on opencl:intel and on opencl:pocl, since a piece whose end slopes rule a root
out is left; 12 halvings take 0.55 times as long as 22.
"""

from functools import lru_cache
from itertools import product

from harness.contract import Method, Parameter, Surface

PIECES = 16  # of a unit-cube face's side, in each direction


@lru_cache(maxsize=128)
def leads_positively(surface: Surface) -> bool:
    """Whether f's terms of degree 4 are proved positive in every direction: f(o + t d) then has a leading a > 0."""
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
            "halvings of each piece",
            finer="up",
            sweep=(12, 16, 30),
            per="2.0 * DOMAIN_RADIUS",
            printed=12,
        ),
        Parameter("SPLIT", 1, "1: at the roots of f''; 0: at t_M, the root of f''', as printed", printed=0),
    ),
    claims=frozenset({"no_false_hit", "error_below_tolerance"}),
    tolerance=lambda surface, knobs: 2.0 * surface.domain.radius * 0.5 ** (knobs["ITERATIONS"] + 1),
    settings={"D.D. Bisection": {"ITERATIONS": 12, "SPLIT": 0}},
    accepts=accepts,
)
