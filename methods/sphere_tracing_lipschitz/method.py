"""Sphere tracing by |f| over a certified Lipschitz bound, for surfaces that state no distance.

**Source** toledo2007, section 4.3, takes distances as given; Hart 1996 (the paper's reference 13), section 3, divides f
by a Lipschitz bound where none is.

**Theory** Where |grad f| <= L, f needs at least |f| / L to fall to 0, so that a step of this length passes no root.
L is the largest |grad f| over a piece of the domain, proved: gradients are evaluated in ball arithmetic over boxes, the
box of the largest bound is halved first, and the largest bound left is the answer, rounded up. The domain is cut in
SHELLS concentric shells and the bound of shell k holds for the ball that ends with it: a step as long as a shell is
thick, or shorter, ends in the next one at worst, and a ball is convex.

**Changes against the paper**
- |f| / L is far from a distance where |grad f| is far under L, so a threshold on it would end far from the root. The
  march ends where the secant through the last two values reaches 0 within EPSILON, or where f changes sign.
- No step is under EPSILON, so that the march ends in rounded arithmetic. A pair of roots closer than that can be passed,
  and a touch is met only where the secant sees it.
- MAX_EVALUATIONS: the paper does not say when to give up.
"""

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from harness.contract import Box, Domain, FirsthitError, Method, Parameter, Precision, Surface

SLACK = 1.0 + 2.0**-16  # covers the rounding of directions' lengths, of |p| and of the table's numbers in float32
CLOSE = 1.02  # bounds are refined until proved to be within this factor of a gradient that occurs
MAX_BOXES = 1500  # boxes refined for one shell; past it the bound is as certain, only less tight


@lru_cache(maxsize=64)
def shell_bounds(surface: Surface, shells: int) -> tuple[float, ...]:
    """For k = 1 … shells, at least the largest |grad f| in the domain within k/shells of its radius of its centre.

    Raises FirsthitError where a gradient has no finite bound.
    """
    import flint
    from surfaces.evaluation import tape_of
    from surfaces.lowering import gradient, real_tape
    from surfaces.numbers import Balls
    from surfaces.tape import walk

    tape, numbers, arb = gradient(real_tape(tape_of(surface))), Balls(), flint.arb
    domain, radius = surface.domain, surface.domain.radius

    def squared(box: list[Any]) -> Any:
        return sum(numbers.sqr(g) for g in walk(tape, numbers, dict(zip("xyz", box, strict=True))))

    bounds: list[float] = []
    with flint.ctx.workprec(64):
        for k in range(1, shells + 1):
            inner, outer = (radius * j / shells * SLACK for j in (k - 1, k))
            bound = _largest(squared, _box(domain), [arb(c) for c in domain.center], inner / SLACK**2, outer, arb)
            bounds.append(max([bound, *bounds[-1:]]))
    if not bounds[-1] < float("inf"):
        raise FirsthitError(f"{surface.name}: its gradient has no finite bound over the domain")
    return tuple(bounds)
