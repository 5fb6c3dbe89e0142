"""Binary search on the number of roots that Sturm's theorem counts.

**Source** toledo2007, sections 3 (cubics) and 4.1 (quartics).

**Theory** Sturm: the changes of sign along the chain f, f', and the negated remainder of each two by division, are
fewer at b than at a by the number of distinct roots in (a, b]. Halving the interval towards the first root needs the
chain at one new point each time, since the near end's count stays. A ray without a root ends before the search.

**Changes against the paper**
- BY_SIGN = 1: once one root is left and f differs in sign at the interval's ends, f alone decides which half holds it.
  BY_SIGN = 0 counts along the chain to the end, as the paper does.
- Where a leading coefficient is zero or small against its row over the ray's stay, division by it leaves nothing but
  roundings: along an axis, where f is often of lower degree (x^3 + y^2 + z^2 along y) or a remainder is (x^4 - 1 leaves
  a constant), and a hair off it. With u for the roundoff and e for the coefficient's share, the rest is off by u / e^2,
  so with CAREFUL = 1 the chain is made anew in double words (u^2 / e^2), of f over [-1, 1], where e is under SHARE.
  What is under LEAST roundoffs even there counts as 0, and the row's degree is lower. Of 5,980 rays along axes and
  diagonals, and a hair off, at the catalog's surfaces to degree 4, 6 are answered wrongly in float32 and 2 in float64
  (tests/test_axis_rays.py). CAREFUL = 0 divides by any leading coefficient, as printed, and has the defects that the
  paper reports.
- The paper prints its error, 25e-6 r, and not how often it halves. As printed it is 18 times, the fewest that keep it:
  half of what they leave of the torus' box is 1.8e-5 r at most, with 17 it is 3.7e-5 r.
- Rays begin at their point nearest the domain's centre (the axis `origins`). The paper's t is 0 at o, which may be read
  as the box, where its tables are run here, or as the eye. Of 24,576 rays of Table 1's views (opencl:pocl, float32) the
  printed setting gets none wrong from the nearest point and from the box, and 72 from the eye; its largest error is
  1.7e-5 r, 2.2e-5 r and 1.6e-2 r. Near singular points the box is worse too: of 9,216 rays at the end of Whitney's
  umbrella's handle (configs/toledo-fig2-zoom.toml, closely; opencl:intel) 45, 1,375 and 2,804 are wrong.
- A chain with a member that is no finite number decides nothing, nor does one that counts more roots before the near
  end than before the far one: the ray ends as exhausted.
- Degrees 1 and 2 and 5 to 16 are a stated extension. Beyond 4 the coefficients are fitted (szente, section 2.1) over
  the ray's stay as x in [-1, 1]. Each row of the chain is divided by its largest coefficient, so that none overflows;
  rows are kept in two parts for each coefficient (double-word arithmetic), since each division loses digits, and
  degrees may drop by more than one here too (the 16-ball along an axis). Once one root is left, f itself decides which
  half holds it, not the fit.

No claim is stated. Beyond degree 4 roots are counted by the fit, whose error grows with the samples far from the root:
on the gallery of the tests (quaste, enneper, daisy, spitz) right hits are off by thousands of times the tolerance.

One evaluation is counted for each point at which f or the chain is evaluated.

**Accuracy** (opencl:intel, 96x96, 30°/35°, rays outside the grazing class; wrong answers and the 99th percentile of
the error over the scene radius.) Float32: torus 2 false hits of 8874, Endraß octic 2 wrong roots of 9032, none on the
Barth sextic, the Barth decic and the 16-ball; 4e-7 to 6e-7. Float64: none anywhere; 2e-7, which is 22 halvings.

**Speed** (opencl:intel, float32, torus at 1024x1024, 30°/35°, time above the null method's.) Kept: BY_SIGN = 1, 1.5
times faster than counting to the end, by two loops: one that counts until a single root is left, and one that only
looks at f. CAREFUL = 1 takes 1.2 to 1.3 times as long as CAREFUL = 0 on opencl:intel and 1.3 to 1.6 times on
opengl:llvmpipe (512x512, rounds by turns: torus, Kummer's quartic, tangle, Cayley's cubic), since the second chain
stands in the program, and all rays of a vector run it where one needs it. SHARE = 2^-10 takes 1.3, 2.1 and 2.0 times as
long as 2^-16 and answers all of 36,864 rays rightly on each of the quartics, of which 2^-16 gets 5, 5 and 2 wrong.
Rejected: a change of variable, x = (y + 1/2) / (1 + y/2), in place of double words, which is no faster on
opencl:intel, slower on opengl:llvmpipe and gets 49 of the 5,980 rays wrong; a second chain with indices known at run
time only (1.9 on opengl:llvmpipe); remainders multiplied out instead of divided, which over seven views at 256x256 lost
23 rays, where division lost 14.
"""

from harness.contract import Method, Parameter, Surface

MAX_DEGREE = 16


def accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "no polynomial, so it has no Sturm chain"
    return None if 1 <= surface.degree <= MAX_DEGREE else f"degree {surface.degree}: the chain is for 1 to {MAX_DEGREE}"


METHOD = Method(
    name="sturm",
    source="toledo2007",
    needs=("surface_polynomial_along", "surface_along", "surface_value_along"),
    libraries=("double_word",),
    parameters=(
        Parameter(
            "ITERATIONS",
            22,
            "halvings of the ray's stay in the domain",
            finer="up",
            sweep=(12, 16, 30),
            per="2.0 * DOMAIN_RADIUS",
            printed=18,
        ),
        Parameter("BY_SIGN", 1, "1: bisect by the sign of f once one root is left; 0: count to the end", printed=0),
        Parameter("DISCARD", 1, "1: a ray without a root ends before the search, as printed; 0: after it"),
        Parameter(
            "CAREFUL",
            1,
            "to degree 4, where a leading coefficient is small: 1: make the chain in double words; 0: divide by it",
            printed=0,
        ),
        Parameter(
            "SHARE",
            0.0000152587890625,
            "of CAREFUL: the share of its row, over the ray's stay, under which a leading coefficient is small",
        ),
        Parameter(
            "LEAST", 64.0, "in double words: least leading coefficient of a row, over its largest one, in roundoffs"
        ),
    ),
    settings={"Sturm": {"ITERATIONS": 18, "BY_SIGN": 0, "CAREFUL": 0}},
    accepts=accepts,
)
