"""Newton-Raphson with a bounded step, started on the bounding sphere.

**Source** toledo2007, section 4.4 (equations 4 and 5); ray-torus quartic: equation 2.

**Theory** Outside the surface f has one sign, and a Newton step along the ray stops short of the first root where f is
convex there; near a simple root it converges quadratically. Close to a local extreme of f the step would be far too
long, so it is bounded by λ. Nothing proves that the root found is the first: the start, close in front of the surface,
is what makes it so in practice.

**Changes against the paper**
- Equation 5's step is signed: where a ray passes the surface closely, f falls and rises again without a root, and the
  step turns back into the dip, where the ray stays until its budget ends. Here a step goes forwards outside the
  surface and backwards inside it, whatever the derivative's sign (FORWARD = 1). FORWARD = 0 is the step as printed;
  configs/newton-steps.toml runs both. Of Table 1's views it leaves 104 to 912 of 16,384 rays without an answer. The
  paper would discard their fragments: rightly, but for 4 rays at 54° and 232 at 72° that hit the torus behind the dip.
  A signed step that converges before the ray's start is no answer either.
- The paper does not say when to give up. Here a ray ends as a miss where it leaves the bounding sphere or the domain,
  and as exhausted after MAX_EVALUATIONS. As printed it gets 20, which is our reading: no clear hit of Table 1's views
  needs more than 10, and with 100 the rays that stay in a dip take two thirds of all evaluations.
- Of the threshold the paper says that it assures the error. We read: the last step is shorter than it.
- Rays begin at their point nearest the domain's centre (the axis `origins`), the paper's at the box, where its tables
  are run here. Of 24,576 rays of Table 1's views (opencl:pocl, float32) "Newton 0.00003" gets 1,004 wrong from the
  nearest point, 1,006 from the box and 3,508 from the eye, where f's roundings keep steps above the threshold.
- Surfaces other than the torus are a stated extension: the paper's λ = 0.15 is relative to its canonical torus
  (R + r = 1), here to the bounding radius; its thresholds are relative to the minor radius r, here to the surface's
  feature radius, or its domain's radius where none is stated.

**What the start on the sphere is worth** (SPHERE_START; torus, Table 1's views, EPSILON 0.001.) Forwards it takes 1.2
evaluations a ray at 0° and not 1.7, 0.5 at 90° and not 0.9; no ray is wrong either way. With signed steps 912 rays of
16,384 are exhausted at 0° and not 2,520: without it they start in front of more dips. In time, opencl:pocl, above the
null method's: 0.90 times as long forwards, 0.66 to 0.75 times as long as printed.
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="newton",
    source="toledo2007",
    needs=("surface_along", "surface_dual_along"),
    parameters=(
        Parameter(
            "EPSILON",
            0.001,
            "last step allowed, over the surface's feature radius",
            finer="down",
            sweep=(0.03, 0.01, 0.0003, 0.0001, 0.00003, 0.00001),
            per="FEATURE_RADIUS",
        ),
        Parameter("STEP_BOUND", 0.15, "longest step λ, over the bounding radius"),
        Parameter("FORWARD", 1, "1: forwards outside the surface, backwards inside; 0: signed as printed", printed=0),
        Parameter(
            "SPHERE_START", 1, "1: from the bounding sphere, as printed; 0: from where the ray enters the domain"
        ),
        Parameter("MAX_EVALUATIONS", 100, "evaluations spent on one ray", printed=20),
    ),
    settings={
        "Newton 0.001": {"EPSILON": 0.001, "FORWARD": 0, "MAX_EVALUATIONS": 20},
        "Newton 0.00003": {"EPSILON": 0.00003, "FORWARD": 0, "MAX_EVALUATIONS": 20},
    },
)
