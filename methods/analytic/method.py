"""All roots of f along the ray in closed form, for degrees 1 to 4; the nearest one is the answer.

The kernel expands f along the ray as a polynomial, writes it in Bernstein form over the ray's interval in the domain,
and computes all real roots by formula. The root with the smallest t in the interval is the hit. POLISH steps of
Newton's method on f refine it.

**Source** Loop and Blinn 2006. What is used of it here is its abstract, US patent 7,924,278, and what toledo2007
(section 2) criticises in it. harness/kernels/glsl/lib/closed_form.glsl names the sources of the closed forms.

**Theory** Let u in [0, 1] be the position in the interval, and substitute s = u / (1 - u). Then f becomes a polynomial
in s, whose coefficients are the Bernstein coefficients times binomials, and the interval becomes s >= 0. If all
coefficients have one sign and none of them is 0, f has no root in the interval, and the ray is a miss at once
(EARLY_EXIT, as Loop and Blinn do it). This test keeps touches: a touch gives two changes of sign, or, at an end of the
interval, a coefficient that is 0. Otherwise the polynomial is solved from the end at which |f| is larger, so that this
larger value is the leading coefficient. Every real root is found, so the first one is found. A touch is found too where
rounding leaves its root real.

**Changes against the paper**
- The coefficients along the ray come from the exact expansion of f. Loop and Blinn interpolate tensors over the
  triangles of a projected Bézier tetrahedron, and bound the polynomial by the least and the greatest depth in it. Here
  the polynomial is bounded by the ray's interval in a box or ball. Degrees 1 to 4 only, and one piece only.
- SCREEN: Loop and Blinn's variable is depth after the perspective division (SCREEN = 2). The default is the distance
  along the ray (SCREEN = 0). SCREEN = 1 is depth from the near plane (0) to the far plane (1), whatever the domain is:
  it shows the noise that, as toledo2007 observes, depends on the choice of these planes.
- EYE, NEAR and FAR are knobs, since a kernel does not know the camera. The eye is taken to stand EYE in front of the
  ray's point nearest the domain's centre.
- WIDENING: the interval is widened by this share of its length at both ends, except where SCREEN = 1. A tight box ends
  where the surface touches it; there f = 0, so the leading coefficient would be lost. Without widening the torus has up
  to 2 % of wrong roots in float32. Loop and Blinn's tetrahedron is not tight.
- POLISH: Newton steps on f along the ray end the search. 0 leaves the closed form's root as it is, as printed.
- Rays begin at their point nearest the domain's centre (`origins` of a config); the eye and the planes stay where they
  are. Of 24,576 rays of Table 1's views (opencl:pocl, float32) the printed setting gets none wrong from there, none
  wrong from the box, and 54 wrong from the eye. Its largest error is 4.1e-5, 6.2e-5 and 3.0e-2 of the minor radius.
- The sources cited above do not say how Loop and Blinn solve the quartic. The closed forms here are our choice.

**Evaluations counted** The coefficients along the ray count as one evaluation, and each Newton step of POLISH as one.

**Accuracy** Largest error over the radius; torus from three sides, opencl:intel, float32. Over depth between the planes
99 of 100 errors are under 3e-3, over depth between the ends of the interval under 3e-6.

    variable                                              POLISH  image    largest error
    ----------------------------------------------------  ------  -------  -------------
    distance (SCREEN = 0)                                 0       192x192  2e-5
    distance (SCREEN = 0)                                 1       192x192  3e-6
    depth between the ends of the interval (SCREEN = 2)   0       128x128  1e-5
    depth between the planes (SCREEN = 1)                 0       128x128  1e-2

**What was tried** Wrong rays: float32, opencl:intel, sum over all catalog surfaces up to degree 4, at 192x192 from
three sides; the default has 49. Speed: how many times as fast as the same kernel with the alternative, processor time
in float32 at 512x512 on each device. Speeds are the mean of torus, Kummer, tangle and Steiner's surface; those of the
first two rows are the mean of these and of Cayley's and Cartan's. LDL^T leaves no wrong ray on Himmel, Kolibri and
Kummer, but up to 66 in place of 5 in one view of Steiner's surface, where four roots lie close together in the middle
of the interval.

    what was tried                                              wrong rays      intel  pocl  llvmpipe  kept
    ----------------------------------------------------------  --------------  -----  ----  --------  ----
    EARLY_EXIT = 1, over EARLY_EXIT = 0                         49              0.97   1.12  0.98      yes
    cbrt (in GLSL pow), acos and cos, over square roots and     -               1.02   0.87  1.03      no
      polynomials; without a correction, acos on llvmpipe has
      twelve times the error (Cayley, 5e-5 against 4e-6)
    Newton's iteration from a bound, without early exit, over   50              0.69   0.88  0.84      no
      the closed form
    the LDL^T form of Orellana and De Michele (not depressed),  99              0.99   1.01  1.01      no
      over Descartes'
    LDL^T with the best of their three formulas for the         63              -      -     -         no
      factors
    LDL^T with that, and one Newton step on the factors         48              0.88   0.94  0.98      no
      (Strobach 2010 ends with one too)
    WIDENING = 1/16, over 1/4                                   20, but 8 of    -      -     -         no
                                                                the torus'
                                                                grazing rays,
                                                                in place of 1
"""

from harness.contract import Method, Parameter, Surface


def accepts(surface: Surface) -> str | None:
    """Say why the surface has no closed form; None if it has one."""
    if surface.degree is None:
        return "no polynomial, so it has no closed form"
    return None if 1 <= surface.degree <= 4 else f"degree {surface.degree} has no closed form"


METHOD = Method(
    name="analytic",
    source="Loop and Blinn 2006, in toledo2007",
    label="Analytic roots",
    needs=("surface_coefficients_along",),
    libraries=("closed_form",),
    parameters=(
        Parameter("POLISH", 1, "steps of Newton's method on f after the closed form", finer="up", printed=0),
        Parameter(
            "EARLY_EXIT",
            1,
            "1: a ray is a miss where all its Bernstein coefficients have one sign; 0: roots are computed first",
        ),
        Parameter(
            "WIDENING", 0.25, "length by which the ray's interval is widened at each end, over the interval's length"
        ),
        Parameter(
            "SCREEN",
            0,
            "the polynomial's variable; 0: distance along the ray; 1: perspective depth from the near to "
            "the far plane; 2: perspective depth between the interval's ends",
            printed=2,
        ),
        Parameter(
            "EYE",
            3.875,
            "distance of the assumed eye from the ray's point nearest the centre, over the domain's "
            "radius (SCREEN 1, 2)",
        ),
        Parameter("NEAR", 0.5, "distance of the near plane from the assumed eye, over the domain's radius (SCREEN 1)"),
        Parameter("FAR", 64.0, "distance of the far plane from the assumed eye, over the domain's radius (SCREEN 1)"),
    ),
    settings={"Loop-Blinn": {"POLISH": 0, "SCREEN": 2}},
    accepts=accepts,
)
