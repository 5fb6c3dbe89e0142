"""Sphere tracing by |f| over a certified Lipschitz bound, for surfaces that state no distance.

The kernel marches along the ray. A step is |f| divided by a bound of the gradient's length, which the host proves
beforehand, once for each of SHELLS concentric shells of the domain. The march ends where a secant step would be shorter
than EPSILON, or where f changes sign.

**Source** toledo2007, section 4.3, takes distances as given. Hart 1996 (the paper's reference 13) divides f by a
Lipschitz bound where there is none.

**Theory** Where |grad f| <= L, f needs a length of at least |f| / L to fall to 0, so a step of this length passes no
root. L is proved: |grad f| is bounded in ball arithmetic over boxes that cover the domain, and boxes are split until
the bound is close to a gradient that occurs. The domain is cut into SHELLS concentric shells. A step is never longer
than a shell is thick, so a step from one shell ends in the next one at the latest. Therefore the L used there is that
of the whole ball that ends with the next shell (a ball is convex, so it holds the step). Through kinks, cone points
and smooth minima the bound is that of surfaces/proofs/slopes.py, which for most distance functions is 1. An f that
may jump is refused.

**Changes against the paper**
- Where |grad f| is far below L, |f| / L is far below the distance, and a threshold on it would end far from the root.
  So the march ends where the secant through the last two values reaches 0 within EPSILON, or where f changes sign.
- No step is shorter than EPSILON, so that the march ends in rounded arithmetic. Roots that are closer to each other
  than that can be passed.
- SHELLS: Hart divides by one bound. Here each shell has its own; SHELLS = 1 is one bound for the whole domain.
- There is one start. A second one is for the two minima of a distance, which are known of the torus only.

**Evaluations counted** Evaluations of f.

**What was tried** opencl:intel, float32, torus and Barth sextic at 512x512, interleaved.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    16 shells, over one bound                               2.5 times fewer evaluations                         yes
    64 shells, over 16                                      1.2 to 1.5 times faster                             yes
    squared distances and reciprocals, over a root and a    1.2 times faster                                    yes
      division in each step
    EPSILON = 2^-14, over 2^-18                             1.4 to 1.6 times faster at the same error, since    no
                                                            the secant ends the march. 2^-15 is the default,
                                                            for the sake of close pairs of roots
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import product
from typing import TYPE_CHECKING

from harness.contract import Box, FirsthitError, Method, Parameter, Precision, Surface

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from surfaces.tape import Tape

SLACK = 1.0 + 2.0**-16  # covers the float32 rounding of a direction's length, of |p|, of the clip and of the table
CLOSE = 1.05  # boxes are split until their bound is within this factor of a gradient that occurs
MAX_BOXES = 6000  # limit of boxes that are bounded; with fewer the bounds are as certain, but less tight
MAX_OPERATIONS = 12_000_000  # of balls that are spent on them, which takes about a quarter of a minute
AWAY = 2.0**-12  # of the radius
KINKED = frozenset({"abs", "min", "max", "sqrt", "powr"})  # whose slopes surfaces.proofs.slopes bounds more tightly
RATIONAL = frozenset({"var", "const", "add", "sub", "mul", "div", "neg", "sqr", "powi"})


def steepest_of_boxes(tape: Tape, boxes: NDArray[np.float64]) -> list[float]:
    """Return an upper bound of the length of the gradient, which `tape` computes, in each of n boxes.

    `boxes`, float64[n, 2, 3], are middles and half sides. All boxes take each operation together; a bound is infinite
    where no ball says anything.
    """
    import numpy as np

    from harness.oracle.balls64 import GROW, UNIT, Balls, hull
    from surfaces.numbers import Arithmetic
    from surfaces.tape import walk

    class Arrays(Arithmetic):
        def const(self, value: Fraction) -> Balls:
            rounded = value.numerator / value.denominator
            return Balls(rounded, UNIT * abs(rounded))

        def sqr(self, a: Balls) -> Balls:
            least, most = np.maximum(np.abs(a.mid) - a.rad, 0.0), np.abs(a.mid) + a.rad  # tighter than a product
            return hull(least * least / GROW, most * most * GROW)

    with np.errstate(all="ignore"):  # what overflows is infinite, and says nothing
        numbers = Arrays()
        slopes = walk(tape, numbers, {axis: Balls(*boxes[:, :, k].T) for k, axis in enumerate("xyz")})
        squares = [numbers.sqr(slope).upper for slope in slopes]
        bounds = np.broadcast_to(np.sqrt(sum(squares)) * GROW, len(boxes))
    return [bound if math.isfinite(bound) else math.inf for bound in bounds.tolist()]


@lru_cache(maxsize=128)
def ball_bounds(surface: Surface, shells: int) -> tuple[float, ...]:
    """Return for k = 1 … shells an upper bound of |grad f| in the domain within k/shells of its radius of its centre.

    Raises FirsthitError where a bound is not finite.
    """
    import flint
    import numpy as np

    import surfaces
    from surfaces.lowering import gradient, real_tape
    from surfaces.numbers import Balls
    from surfaces.proofs.slopes import steepest as bound_of_slope
    from surfaces.tape import walk

    value = real_tape(surfaces.tape_of(surface))
    tape, numbers, kinked = gradient(value), Balls(), any(op.name in KINKED for op in value.ops)
    most = max(64, min(MAX_BOXES, MAX_OPERATIONS // len(tape.ops)))
    domain, center, radius = surface.domain, surface.domain.center, surface.domain.radius * SLACK
    half = np.subtract(domain.upper, domain.lower) / 2 if isinstance(domain, Box) else np.full(3, domain.radius)

    def steepest(middle: Sequence[float], half: Sequence[float]) -> float:
        box = {axis: flint.arb(m, h) for axis, m, h in zip("xyz", middle, half, strict=True)}
        if kinked:
            return bound_of_slope(value, box) * SLACK
        size = sum(numbers.sqr(slope) for slope in walk(tape, numbers, box))
        return math.sqrt(float(size.upper())) * SLACK if size.is_finite() else math.inf

    def all_steepest(boxes: Sequence[tuple[Sequence[float], Sequence[float]]]) -> list[float]:
        if not boxes or not all(op.name in RATIONAL for op in tape.ops):
            return [steepest(*box) for box in boxes]
        return [bound * SLACK for bound in steepest_of_boxes(tape, np.array(boxes))]

    def ball(middle: Sequence[float], half: Sequence[float]) -> int:
        """Return the number of the smallest ball that the box reaches into; `shells` where it reaches into none."""
        away = (max(abs(m - c) - h, 0.0) for m, c, h in zip(middle, center, half, strict=True))
        return int(shells * math.hypot(*away) / radius)

    grid = np.stack(np.meshgrid(*[np.linspace(-1.0, 1.0, 33)] * 3), -1).reshape(-1, 3) * half + center
    if kinked:
        grid += AWAY * radius  # a cone point, where no slope says anything, is often at the centre
    distances = np.linalg.norm(grid - center, axis=1)
    slopes = np.linalg.norm(surfaces.gradient(surface, grid), axis=1)
    occurring = [slopes[distances <= radius * (k + 1) / shells].max() for k in range(shells)]

    bounds = [0.0] * shells
    open_boxes = [(tuple(center), tuple(half * SLACK))]
    bounded = 0
    while open_boxes:
        split: list[tuple[Sequence[float], Sequence[float]]] = []
        inside = [(box, reached) for box in open_boxes if (reached := ball(*box)) < shells]
        steep = all_steepest([box for box, _ in inside])
        for ((middle, size), reached), bound in zip(inside, steep, strict=True):
            bounded += 1
            if bound > CLOSE * occurring[reached] and bounded + 8 * len(split) < most:
                split.append((middle, size))
            else:
                bounds[reached] = max(bounds[reached], bound)
        open_boxes = [
            (tuple(m + s * h / 2 for m, s, h in zip(middle, signs, size, strict=True)), tuple(h / 2 for h in size))
            for middle, size in split
            for signs in product((-1, 1), repeat=3)
        ]
    bounds = [max(bounds[: k + 1]) for k in range(shells)]
    if not bounds[-1] < math.inf:
        raise FirsthitError(f"{surface.name}: its gradient has no finite bound over the domain")
    return tuple(bounds)


def accepts(surface: Surface) -> str | None:
    """Say why the surface is refused; None if f does not jump."""
    import surfaces
    from surfaces.proofs.slopes import jumps

    found = jumps(surfaces.tape_of(surface))
    return f"f may jump ({', '.join(found)}), and a bound of its gradient says nothing of jumps" if found else None


def tables(surface: Surface, knobs: Mapping[str, float | int], _: Precision) -> Mapping[str, Sequence[float]]:
    """Return REACH: from shell k a step of REACH[k] times |f| passes no root."""
    bounds = ball_bounds(surface, int(knobs["SHELLS"]))
    return {"REACH": [1.0 / bound for bound in (*bounds[1:], bounds[-1])]}


METHOD = Method(
    name="sphere_tracing_lipschitz",
    source="toledo2007",
    label="Lipschitz sphere tracing",
    needs=("surface_along", "surface_value_along"),
    parameters=(
        Parameter(
            "EPSILON",
            2.0**-15,
            "shortest step, and longest secant step that counts as a hit, over the domain's radius",
            finer="down",
            sweep=(2.0**-10, 2.0**-12, 2.0**-18),
            per="DOMAIN_RADIUS",
        ),
        Parameter(
            "SHELLS",
            64,
            "concentric shells of the domain that have a bound each; 1: one bound for the whole domain",
            printed=1,
        ),
        Parameter("MAX_EVALUATIONS", 20000, "evaluations of f on one ray, after which the ray is exhausted"),
    ),
    claims=frozenset({"conservative_bound"}),
    accepts=accepts,
    tables=tables,
)
