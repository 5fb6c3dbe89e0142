"""Equidistant steps to the first change of sign, then bisection.

**Source** szente, sections 1 and 4: the paper's ground truth and baseline, with its cap of 10,000 steps.

**Theory** A crossing between two samples changes the sign of f, and bisection keeps the change bracketed. Roots that
come in pairs closer than a step, and touches, are missed.

**Changes against the paper**
- EXPAND: to degree 4 f's expansion along the ray is marched; the paper marches f.
- BLOCK: steps are looked at in blocks, whose evaluations do not wait for one another, and step by step only in the
  block that holds the change: the same steps and answers.
- REFINEMENTS, SECANT: the paper does not say how the bracket is refined, and its code bisects 8 times; here 12 times,
  and a secant step ends it.
- The paper gives the cap and no step length: here as many steps as the cap span the domain's diameter, so that no ray
  runs out of steps. Its code takes 1,000. The march's time grows with STEPS, and so does every speed-up over it.

**Speed** Processor time on opencl:intel, float32, 256 x 256, Table 4's surfaces in the domains of
configs/szente-table4.toml, our march over the printed one, step by step: 2.9 (decic) to 5.8 (torus) times faster, all
but 3 % of it by blocks of 8; the expansion saves 4 to 8 % on the sphere and the torus. On opengl:llvmpipe blocks are
worth 2.8 to 3.4. A torus in its tight box takes a march 602 evaluations a ray, in its ball 2,450 (R = 0.7, r = 0.3, 128
x 128). Blocks of 4: 1.34 times faster on the decic, 0.88 on the sphere and the sextic; of 16: 0.77 on the sextic.
Rejected: a vector's 16 rays from 4 x 4 pixels instead of a row of 16 (1.03 to 1.07, but its scattered stores cost the
cheap methods a quarter).
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
