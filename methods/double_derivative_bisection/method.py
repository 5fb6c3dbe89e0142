"""Bisection on f and, where f does not change sign, on its derivative; once on each side of t_M = -b/(4a).

**Source** toledo2007, section 4.2 (equation 3 and Figure 3).

**Theory** Between two ends where f has one sign, with one extreme towards 0 between them, halving by the sign of f'
comes down on the extreme; where f changes sign on the way there, halving goes on by the sign of f and finds the first
root. A quartic with a > 0 falls, rises, falls and rises again at most. The root of its third derivative, t_M, is the
mean of its three extremes and so lies between the outer two: it parts the two minima.

**Changes against the paper**
- t_M parts the minima but can lie past the maximum between them; then its left side falls, rises and falls again, and
  neither situation of the paper is at hand: at 18° of elevation (72° in Table 1) 3 % of the torus's rays then get a
  later root. SPLIT = 1 searches three pieces, parted where f'' changes sign: f is convex on the outer two and concave
  between them, so one of the situations is always at hand. SPLIT = 0 parts at t_M only, as printed.
- A start inside the surface (f < 0) is the paper's second situation.
- The paper's error 0.0014 r needs 12 halvings; ITERATIONS is more by default, see `variants`.

One evaluation of f with its derivative is counted for each point.

**Speed** (opencl:intel, float32, torus at 1024x1024, 30°/35°, time above the null method's.) Three pieces instead of
two take 1.1 times as long, 12 halvings instead of 22 half as long. Kept: a piece whose ends rule a root out is left
before its loop.
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
            "ITERATIONS", 22, "halvings of each piece", finer="up", sweep=(12, 16, 30), per="2.0 * DOMAIN_RADIUS"
        ),
        Parameter("SPLIT", 1, "1: at the roots of f''; 0: at t_M, the root of f''', as printed"),
    ),
    claims=frozenset({"no_false_hit", "error_below_tolerance"}),
    tolerance=lambda surface, knobs: 2.0 * surface.domain.radius * 0.5 ** (knobs["ITERATIONS"] + 1),
    settings={"D.D. Bisection": {"ITERATIONS": 12, "SPLIT": 0}},
    accepts=accepts,
)
