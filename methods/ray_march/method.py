"""Equidistant steps to the first change of sign, then bisection.

**Source** szente, sections 1 and 4: the paper's ground truth and baseline, with its cap of 10,000 steps.

**Theory** A crossing between two samples changes the sign of f, and bisection keeps the change bracketed. Roots that
come in pairs closer than a step, and touches, are missed.

**Changes against the paper**
- The paper gives the cap but not the step: here the cap's worth of steps spans the domain's diameter, so that no ray
  runs out of steps.
- The paper does not say how the bracket is refined: bisection, REFINEMENTS times, ending with one secant step.
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="ray_march",
    source="szente",
    needs=("surface_along", "surface_value_along"),
    parameters=(
        Parameter("STEPS", 10000, "steps across the domain's diameter", finer="up", sweep=(100, 300, 1000)),
        Parameter(
            "REFINEMENTS", 12, "bisections of the bracketing step", finer="up", per="2.0 * DOMAIN_RADIUS / real(STEPS)"
        ),
    ),
    claims=frozenset({"no_false_hit", "error_below_tolerance"}),
    tolerance=lambda surface, knobs: 2.0 * surface.domain.radius / knobs["STEPS"] * 0.5 ** knobs["REFINEMENTS"],
)
