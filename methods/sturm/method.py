"""Binary search on the number of roots that Sturm's theorem counts.

**Source** toledo2007, sections 3 (cubics) and 4.1 (quartics).

**Theory** Sturm: the changes of sign along the chain f, f', and the negated remainder of each two by division, are
fewer at b than at a by the number of distinct roots in (a, b]. Halving the interval towards the first root needs the
chain at one new point each time, since the near end's count stays. A ray without a root ends before the search.

**Changes against the paper**
- BY_SIGN = 1: once one root is left and f differs in sign at the interval's ends, f alone decides which half holds it.
  BY_SIGN = 0 counts along the chain to the end, as the paper does.
- A chain with a member that is no finite number decides nothing: the ray ends as exhausted.
- Degrees 1 and 2 are a stated extension. Beyond 4 no exact coefficients along a ray are generated: see `accepts`.

One evaluation is counted for each point at which f or the chain is evaluated.

**Speed** (opencl:intel, float32, torus at 1024x1024, 30°/35°, time above the null method's.) Kept: BY_SIGN = 1, 1.5
times faster than counting to the end, by two loops: one that counts until a single root is left, and one that only
looks at f. Rejected: remainders multiplied out instead of divided; over seven views at 256x256 they lost 23 rays, and
division 14.
"""

from harness.contract import Method, Parameter, Surface


def accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "no polynomial, so it has no Sturm chain"
    return None if 1 <= surface.degree <= 4 else f"degree {surface.degree}: coefficients along a ray are known to 4"


METHOD = Method(
    name="sturm",
    source="toledo2007",
    needs=("surface_coefficients_along",),
    parameters=(
        Parameter("ITERATIONS", 22, "halvings of the ray's stay in the domain"),
        Parameter("BY_SIGN", 1, "1: bisect by the sign of f once one root is left; 0: count to the end, as printed"),
    ),
    settings={"Sturm": {"ITERATIONS": 18, "BY_SIGN": 0}},
    accepts=accepts,
)
