"""All roots in closed form, from the surface along the ray in Bernstein form; the nearest one is the answer.

**Source** Loop and Blinn 2006, as toledo2007 (section 2) describes and criticises it; the closed forms are named in
harness/kernels/lib/closed_form.glsl.

**Theory** In Bernstein form over an interval u in [0, 1], f is a polynomial in s = u / (1 - u), its coefficients the
Bernstein ones times binomials, and the interval is s >= 0. It is solved from the end where f is larger, so that the
leading coefficient is. Every real root is found; so the first one is, a touch too where rounding leaves it real.

**Changes against the paper**
- The interval is the ray's stay in the domain, in the surface's own coordinates; Loop and Blinn work in screen space.
  SCREEN = 1 does: over depth as the perspective division makes it, 0 at the near plane and 1 at the far plane. The
  planes are knobs; kernels see no camera, so the eye is taken to stand EYE in front of the point nearest the centre.
- The interval is widened by WIDENING of its length at either end: a tight box ends where the surface touches it, and
  with f = 0 there the leading coefficient is lost (without it the torus has up to 2 % of wrong roots in float32).
- POLISH Newton steps on f along the ray end it; 0 leaves the closed form as it is.
- Degrees 1 to 4 only, box or ball instead of Bézier tetrahedra.

The coefficients along the ray count as one evaluation, each Newton step as another.

**Accuracy** (opencl:intel, float32, torus at 256x256, 30°/35°.) The largest error is 8e-6 of the radius without a
Newton step and 2e-6 with one; in screen space without one, 4e-4 with the near plane close to the torus and 2e-2 with
it close to the eye, whatever the far plane.
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
        Parameter("POLISH", 1, "Newton steps on the closed form's root", finer="up"),
        Parameter("WIDENING", 0.25, "how much the interval is widened at either end, over its length"),
        Parameter(
            "SCREEN", 0, "1: in screen space, between the near and the far plane; 0: in the surface's coordinates"
        ),
        Parameter("EYE", 3.875, "distance of the eye from the point nearest the centre, over the domain's radius"),
        Parameter("NEAR", 0.5, "distance of the near plane from the eye, over the domain's radius"),
        Parameter("FAR", 64.0, "distance of the far plane from the eye, over the domain's radius"),
    ),
    settings={"Loop-Blinn": {"POLISH": 0, "SCREEN": 1}},
    accepts=accepts,
)
