"""All roots in closed form, from the surface along the ray in Bernstein form; the nearest one is the answer.

**Source** Loop and Blinn 2006, as its abstract and US patent 7,924,278 state it and toledo2007 (section 2) criticises
it; the closed forms are named in harness/kernels/glsl/lib/closed_form.glsl.

**Theory** In Bernstein form over an interval u in [0, 1], f is a polynomial in s = u / (1 - u), its coefficients the
Bernstein ones times binomials, and the interval is s >= 0. Where all of them have one sign, and none is 0, f has no
root there: a miss at once (EARLY_EXIT, Loop and Blinn's; a touch has two changes of sign, or a 0 at an end, and is
kept). Else f is solved from the end where it is larger, so that the leading coefficient is. Every real root is found;
so the first one is, a touch too where rounding leaves it real.

**Changes against the paper**
- A ray's coefficients come from the exact expansion along it. Loop and Blinn interpolate tensors over the triangles of
  a projected Bézier tetrahedron, with the least and the greatest depth in it, which bound the polynomial. Ours is
  bounded by the ray's stay in a box or ball; degrees 1 to 4 only, one piece.
- Loop and Blinn's variable is depth as the perspective division makes it (SCREEN = 2). Ours is the distance along the
  ray. SCREEN = 1 is depth from the near plane (0) to the far plane (1), whatever the domain: the noise that toledo2007
  sees in the choice of the planes. They are knobs; kernels see no camera, so the eye is taken to stand EYE in front of
  the point nearest the centre.
- The interval is widened by WIDENING of its length at either end, but for SCREEN = 1: a tight box ends where the
  surface touches it, and with f = 0 there the leading coefficient is lost (without it the torus has up to 2 % of wrong
  roots in float32). A tetrahedron is not tight.
- POLISH Newton steps on f along the ray end it; 0 leaves the closed form as it is.
- Rays begin at their point nearest the domain's centre (the axis `origins`); eye and planes stay where they are. Of
  24,576 rays of Table 1's views (opencl:pocl, float32) the printed setting gets none wrong from there and from the box,
  and 54 from the eye; its largest error is 4.1e-5, 6.2e-5 and 3.0e-2 of the minor radius.
- How Loop and Blinn solve the quartic is not in what is cited above; the closed forms here are stated in their file.

The coefficients along the ray count as one evaluation, each Newton step of POLISH as another.

**Accuracy** (opencl:intel, float32, torus from three sides.) The largest error is 2e-5 of the radius without a Newton
step and 3e-6 with one, at 192x192. Over depth, without one, it is 1e-5 between the stay's ends and 1e-2 between the
planes, at 128x128; 99 of 100 errors are under 3e-6 and 3e-3.

**Tried** (float32.) Wrong rays on opencl:intel, of all catalog surfaces to degree 4 at 192x192 from three sides. Speed
in processor time at 512x512 on opencl:intel, opencl:pocl and opengl:llvmpipe, over the same kernel but for what the row
names: of torus, Kummer, tangle and Steiner's surface in the mean, and of Cayley's and Cartan's too above the line.

    EARLY_EXIT = 1, over 0                                                  49   0.97  1.12  0.98
    cbrt (in GLSL pow), acos and cos, over square roots and polynomial      -    1.02  0.87  1.03
    ---
    Newton's iteration from a bound, no early exit, over the closed form    50   0.69  0.88  0.84
    Orellana and De Michele's LDL^T (not depressed), over Descartes'        99   0.99  1.01  1.01
    so, with the best of their three formulas for the factors               63   -     -     -
    so, and one Newton step on the factors (Strobach 2010 ends so too)      48   0.88  0.94  0.98

Without a correction, acos on llvmpipe has twelve times the error (Cayley, 5e-5 against 4e-6). LDL^T leaves no wrong ray
on Himmel, Kolibri and Kummer, but up to 66 in place of 5 in one view of Steiner's surface, where four roots lie close
together in the middle of the interval: left out, as the step on the factors is. WIDENING = 1/16 leaves 20 wrong rays
in place of 49, but more of the torus' grazing ones (8 in place of 1): the default stays.
"""

from harness.contract import Method, Parameter, Surface


def accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "no polynomial, so it has no closed form"
    return None if 1 <= surface.degree <= 4 else f"degree {surface.degree} has no closed form"


METHOD = Method(
    name="analytic",
    source="Loop and Blinn 2006, in toledo2007",
    needs=("surface_coefficients_along",),
    libraries=("closed_form",),
    parameters=(
        Parameter("POLISH", 1, "Newton steps on the closed form's root", finer="up", printed=0),
        Parameter(
            "EARLY_EXIT", 1, "1: a miss where all Bernstein coefficients have one sign; 0: the roots are found first"
        ),
        Parameter("WIDENING", 0.25, "how much the interval is widened at either end, over its length"),
        Parameter(
            "SCREEN",
            0,
            "0: over the distance; 2: over depth, as perspective makes it; 1: so, from the near to the far plane",
            printed=2,
        ),
        Parameter("EYE", 3.875, "distance of the eye from the point nearest the centre, over the domain's radius"),
        Parameter("NEAR", 0.5, "distance of the near plane from the eye, over the domain's radius"),
        Parameter("FAR", 64.0, "distance of the far plane from the eye, over the domain's radius"),
    ),
    settings={"Loop-Blinn": {"POLISH": 0, "SCREEN": 2}},
    accepts=accepts,
)
