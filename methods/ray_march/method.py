"""Equidistant steps to the first change of sign, then bisection.

The kernel evaluates f at equal steps along the ray until its sign changes, halves the last step REFINEMENTS times
around the change, and ends with one secant step.

**Source** szente, sections 1 and 4. There it is the ground truth and the baseline, with at most 10,000 steps.

**Theory** If f has different signs at two neighbouring samples, a root lies between them, and bisection keeps it
between its ends. Touches, and pairs of roots that are closer to each other than a step, are missed. Where f jumps from
one sign to the other, as floor may make it, the jump is taken for a root.

**Changes against the paper**
- EXPAND: to degree 4 the expansion of f along the ray is evaluated. The paper evaluates f.
- BLOCK: samples are taken in blocks whose evaluations do not wait for each other. Only the block that holds the change
  of sign is searched step by step. Steps and answers are the same.
- REFINEMENTS, SECANT: the paper does not say how the step with the change is refined, and its code bisects 8 times.
  Here it is 12 times, and one secant step ends the search.
- STEPS: the paper gives the largest number of steps and no step length. Here so many steps span the domain's diameter,
  so that no ray runs out of steps. The authors' code takes 1,000. The time of the march grows with STEPS, and with it
  every speed-up over the march.

**Evaluations counted** Evaluations of f.

**What was tried** Speed over the alternative: processor time on opencl:intel, float32, 256x256, on the surfaces of
szente's Table 4 in the domains of configs/szente-table4.toml, unless a row says otherwise.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    our march, over the printed one, step by step           2.9 (decic) to 5.8 (torus) times faster; all but    yes
                                                            3 % of it is from blocks of 8
    the expansion alone (EXPAND = 1)                        saves 4 to 8 % on the sphere and the torus          yes
    blocks of 8 on opengl:llvmpipe                          2.8 to 3.4 times faster                             yes
    blocks of 4                                             1.34 times faster on the decic, 0.88 on the sphere  no
                                                            and the sextic
    blocks of 16                                            0.77 on the sextic                                  no
    the 16 rays of a vector from 4 by 4 pixels, in place    1.03 to 1.07, but its scattered stores cost the     no
      of a row of 16                                        cheap methods a quarter
    a torus in its tight box, over the torus in its ball    602 evaluations a ray, against 2,450 (R = 0.7,      -
                                                            r = 0.3, 128x128)
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="ray_march",
    source="szente",
    label="Ray marching",
    needs=("surface_value", "surface_along", "surface_value_along"),
    parameters=(
        Parameter("STEPS", 10000, "steps across the domain's diameter", finer="up", sweep=(100, 300, 1000)),
        Parameter(
            "REFINEMENTS",
            12,
            "bisections of the step in which f changes its sign",
            finer="up",
            per="2.0 * DOMAIN_RADIUS / real(STEPS)",
            printed=8,
        ),
        Parameter(
            "EXPAND", 1, "what is evaluated to degree 4; 1: the expansion of f along the ray; 0: f itself", printed=0
        ),
        Parameter("BLOCK", 8, "steps that are evaluated together before their signs are compared", printed=1),
        Parameter(
            "SECANT", 1, "1: a secant step ends the search; 0: the far end of the last interval is the hit", printed=0
        ),
    ),
    settings={"ray marching": {"REFINEMENTS": 8, "EXPAND": 0, "BLOCK": 1, "SECANT": 0}},
    claims=frozenset({"no_false_hit", "error_below_tolerance"}),
    tolerance=lambda surface, knobs: 2.0 * surface.domain.radius / knobs["STEPS"] * 0.5 ** knobs["REFINEMENTS"],
)
