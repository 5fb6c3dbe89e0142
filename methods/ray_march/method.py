"""Equidistant steps to the first change of sign, then bisection.

**Source** szente, sections 1 and 4: the paper's ground truth and baseline, with its cap of 10,000 steps.

**Theory** A crossing between two samples changes the sign of f, and bisection keeps the change bracketed. Roots that
come in pairs closer than a step, and touches, are missed.

**Changes against the paper**
- The paper gives the cap but not the step: here the cap's worth of steps spans the domain's diameter, so that no ray
  runs out of steps.
- The paper does not say how the bracket is refined: bisection, REFINEMENTS times, ending with one secant step.

**Speed** Processor time on opencl:intel, float32, 512 x 512. Steps are looked at in blocks of 8, whose evaluations do
not wait for one another, and step by step only in the block that holds the change: 2.7 (decic) to 4.9 times (torus)
faster than one by one with the same answers, 2.8 to 3.4 times on opengl:llvmpipe. Blocks of 4: 1.34 times faster on the
decic, 0.88 on the sphere and the sextic; of 16: 0.77 on the sextic. Rejected: a vector's 16 rays from 4 x 4 pixels
instead of a row of 16 (1.03 to 1.07, but its scattered stores cost the cheap methods a quarter).
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="ray_march",
    source="szente",
    needs=("surface_value", "surface_along", "surface_value_along"),
    parameters=(
        Parameter("STEPS", 10000, "steps across the domain's diameter", finer="up", sweep=(100, 300, 1000)),
        Parameter(
            "REFINEMENTS",
            12,
            "bisections of the bracketing step",
            finer="up",
            per="2.0 * DOMAIN_RADIUS / real(STEPS)",
            printed=8,
        ),
        Parameter("EXPAND", 1, "what is marched to degree 4: 1: f's expansion along the ray, 0: f itself", printed=0),
        Parameter("BLOCK", 8, "steps that are looked at together", printed=1),
        Parameter("SECANT", 1, "1: a secant step ends the search, 0: the bracket's far end is the hit", printed=0),
    ),
    settings={"ray marching": {"REFINEMENTS": 8, "EXPAND": 0, "BLOCK": 1, "SECANT": 0}},
    claims=frozenset({"no_false_hit", "error_below_tolerance"}),
    tolerance=lambda surface, knobs: 2.0 * surface.domain.radius / knobs["STEPS"] * 0.5 ** knobs["REFINEMENTS"],
)
