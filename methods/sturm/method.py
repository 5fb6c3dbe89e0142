"""Binary search for the first root by the number of roots that Sturm's theorem counts.

The kernel expands f along the ray as a polynomial (beyond degree 4 it fits one), forms Sturm's chain, and counts the
roots in the ray's interval in the domain. A ray without a root is a miss. Otherwise the interval is halved ITERATIONS
times towards the first root.

**Source** toledo2007, sections 3 (cubics) and 4.1 (quartics).

**Theory** Sturm's chain is f, f' and then, for each two members, the negated remainder of their division. Let V(x) be
the number of sign changes along the chain at x. Then V(a) - V(b) is the number of distinct roots in (a, b]. Each
halving evaluates the chain at one new point only, since the count at the near end stays the same. A ray without a root
ends before the search.

**Changes against the paper**
- BY_SIGN = 1 (default): as soon as one root is left and f differs in sign at the interval's ends, f alone decides which
  half holds the root. BY_SIGN = 0 counts along the chain to the end, as the paper does.
- CAREFUL, SHARE, LEAST: the chain divides by leading coefficients. Where one is 0 or small against the other
  coefficients of its row (a member of the chain) over the ray's interval, the remainder is nothing but rounding errors.
  This happens along an axis, where f often has a lower degree (x^3 + y^2 + z^2 along y) or a remainder has (x^4 - 1
  leaves a constant), and very close to an axis. Let u be the unit roundoff and e the coefficient's share of its row:
  the remainder is off by u / e^2. With CAREFUL = 1 (default), where e is under SHARE, the chain is computed anew in
  double words, for f over [-1, 1], so that it is off by u^2 / e^2. A leading coefficient under LEAST roundoffs even
  there counts as 0, and the degree of its row is lower. Of 5,980 rays along axes and diagonals, and very close to them,
  at the catalog's surfaces to degree 4, 6 are answered wrongly in float32 and 2 in float64 (tests/test_axis_rays.py).
  CAREFUL = 0 divides by any leading coefficient, as printed, and has the defects that the paper reports.
- ITERATIONS: the paper prints its error, 25e-6 r, but not how often it halves. The printed setting takes 18, the fewest
  that keep this error: half of the last interval is at most 1.8e-5 r in the torus' box, and with 17 it is 3.7e-5 r.
- Rays begin at their point nearest the domain's centre (`origins` of a config). The paper's t is 0 at o, which may be
  the box, as configs for its tables read it, or the eye. Of 24,576 rays of Table 1's views (opencl:pocl, float32) the
  printed setting gets none wrong from the nearest point, none wrong from the box, and 72 wrong from the eye. Its
  largest error is 1.7e-5 r, 2.2e-5 r and 1.6e-2 r. Near singular points the box is worse too: of 9,216 rays at the end
  of the handle of Whitney's umbrella (configs/toledo-fig2-zoom.toml, view "zoomed closely"; opencl:intel) 45, 1,375 and
  2,804 are wrong from the three.
- A chain with a member that is not finite decides nothing. Neither does a chain that counts more roots before the near
  end than before the far end. Such a ray ends as exhausted.
- Degrees 1 and 2, and 5 to 16, are an extension of ours. Beyond degree 4 the coefficients are fitted (szente, section
  2.1) over the ray's interval, mapped to x in [-1, 1]. Each row of the chain is divided by its largest coefficient, so
  that none overflows. Coefficients are kept in two parts (double-word arithmetic), since each division loses digits,
  and a division may lower the degree by more than one here too (the 16-ball along an axis). When one root is left, f
  itself, not the fit, decides which half holds it.
- No claim is stated. Beyond degree 4 roots are counted by the fit, whose error grows with the samples far from the
  root: on the tests' gallery (quaste, enneper, daisy, spitz) right hits are off by thousands of times the tolerance.

**Evaluations counted** One for each point at which f or the chain is evaluated.

**Accuracy** opencl:intel, 96x96, azimuth 30° and elevation 35°, rays outside the class `grazing`. The error is the 99th
percentile over the scene's radius. In float64 it is what 22 halvings leave.

    precision  wrong answers                                                            error
    ---------  -----------------------------------------------------------------------  ------------
    float32    torus: 2 false hits of 8874 rays; Endraß octic: 2 wrong roots of 9032    4e-7 to 6e-7
               rays; Barth sextic, Barth decic and 16-ball: none
    float64    none                                                                     2e-7

**What was tried** opencl:intel, float32, torus at 1024x1024, azimuth 30° and elevation 35°, time above the null
method's, unless a row says otherwise. "The quartics" are torus, Kummer's quartic and tangle; with Cayley's cubic they
are the four surfaces, at 512x512 in rounds by turns.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    BY_SIGN = 1, as two loops: one counts until a single    1.5 times faster than counting to the end           yes
      root is left, the other only evaluates f
    CAREFUL = 1, over CAREFUL = 0, on the four surfaces     1.2 to 1.3 times the time on opencl:intel, 1.3 to   yes
                                                            1.6 on opengl:llvmpipe: the second chain is part
                                                            of the program, and all rays of a vector run it
                                                            where one needs it
    SHARE = 2^-10, over 2^-16, on the three quartics        1.3, 2.1 and 2.0 times the time; it answers all of  no
                                                            36,864 rays rightly on each, of which 2^-16 gets
                                                            5, 5 and 2 wrong
    a change of variable, x = (y + 1/2) / (1 + y/2), in     no faster on opencl:intel, slower on                no
      place of double words                                 opengl:llvmpipe; 49 of the 5,980 rays wrong
    a second chain whose indices are known at run time      1.9 times the time on opengl:llvmpipe               no
      only
    remainders multiplied out, in place of divided          23 rays lost over seven views at 256x256, where     no
                                                            division lost 14
"""

from harness.contract import Method, Parameter, Surface

MAX_DEGREE = 16


def accepts(surface: Surface) -> str | None:
    """Say why the surface has no Sturm chain here; None if it has one."""
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
            "halvings of the ray's interval in the domain",
            finer="up",
            sweep=(12, 16, 30),
            per="2.0 * DOMAIN_RADIUS",
            printed=18,
        ),
        Parameter(
            "BY_SIGN",
            1,
            "when one root is left; 1: the sign of f chooses the half; 0: roots are counted to the end",
            printed=0,
        ),
        Parameter("DISCARD", 1, "when a ray without a root ends; 1: before the search, as printed; 0: after it"),
        Parameter(
            "CAREFUL",
            1,
            "to degree 4, where a leading coefficient is small; 1: the chain is computed anew in double "
            "words; 0: it is divided by",
            printed=0,
        ),
        Parameter(
            "SHARE",
            0.0000152587890625,
            "share of its row, over the ray's interval, below which CAREFUL takes a leading coefficient as small",
        ),
        Parameter(
            "LEAST",
            64.0,
            "in double words, leading coefficient below which it counts as 0, in unit roundoffs of its row's largest",
        ),
    ),
    settings={"Sturm": {"ITERATIONS": 18, "BY_SIGN": 0, "CAREFUL": 0}},
    accepts=accepts,
)
