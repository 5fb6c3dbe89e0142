"""The papers' own settings of their methods, and ours, by their knobs."""

from reports.claims.evidence import Pick

_NEWTON = {"STEP_BOUND": 0.15, "FORWARD": 0, "SPHERE_START": 1, "MAX_EVALUATIONS": 20}
NEWTON_3 = Pick("Newton 0.001", "newton", _NEWTON | {"EPSILON": 0.001})
NEWTON_5 = Pick("Newton 0.00003", "newton", _NEWTON | {"EPSILON": 0.00003})
NEWTON_UNBOUND = Pick("Newton with steps up to 100", "newton", _NEWTON | {"EPSILON": 0.001, "STEP_BOUND": 100})
NEWTON_FROM_BOX = Pick("Newton 0.001 from the box", "newton", _NEWTON | {"EPSILON": 0.001, "SPHERE_START": 0})
_FORWARDS = {"STEP_BOUND": 0.15, "FORWARD": 1, "SPHERE_START": 1}
NEWTON_3_FORWARDS = Pick("Newton 0.001 forwards", "newton", _FORWARDS | {"EPSILON": 0.001})
NEWTON_5_FORWARDS = Pick("Newton 0.00003 forwards", "newton", _FORWARDS | {"EPSILON": 0.00003})
FORWARDS_UNBOUND = Pick("steps forwards up to 100", "newton", _FORWARDS | {"EPSILON": 0.001, "STEP_BOUND": 100})
FORWARDS_FROM_BOX = Pick("forwards from the box", "newton", _FORWARDS | {"EPSILON": 0.001, "SPHERE_START": 0})
_STURM = {"BY_SIGN": 0, "CAREFUL": 0}
STURM = Pick("Sturm", "sturm", _STURM | {"ITERATIONS": 18, "DISCARD": 1})
STURM_FROM_EYE = Pick("Sturm from the eye", "sturm", STURM.knobs, "eye")
STURM_SEARCHING = Pick("Sturm that discards after its search", "sturm", _STURM | {"ITERATIONS": 18, "DISCARD": 0})
STURM_SHORT = Pick("Sturm with 8 halvings", "sturm", _STURM | {"ITERATIONS": 8, "DISCARD": 1})
STURM_BY_SIGN = Pick("Sturm by sign", "sturm", {"BY_SIGN": 1, "ITERATIONS": 18})
BISECTION = Pick("D.D. Bisection", "double_derivative_bisection", {"SPLIT": 0, "ITERATIONS": 12})
BISECTION_AT_BENDS = Pick("D.D. Bisection at f'' = 0", "double_derivative_bisection", {"SPLIT": 1, "ITERATIONS": 12})
ONE_RAY = Pick("Sphere Tracing", "sphere_tracing", {"RAYS": 1, "EPSILON": 0.001})
TWO_RAYS = Pick("2-rays S. Tracing", "sphere_tracing", {"RAYS": 2, "EPSILON": 0.001, "AHEAD": 0})
TWO_RAYS_AHEAD = Pick("2-rays S. Tracing ahead", "sphere_tracing", {"RAYS": 2, "EPSILON": 0.001, "AHEAD": 1})
LOOP_BLINN = Pick("Loop-Blinn", "analytic", {"SCREEN": 2, "POLISH": 0})
BETWEEN_PLANES = Pick(
    "Loop-Blinn between close planes", "analytic", {"SCREEN": 1, "POLISH": 0, "NEAR": 2.5, "FAR": 6.0}
)
CLOSED_FORM = Pick("a closed form", "analytic")
ANALYTIC = Pick("closed form", "analytic", {"SCREEN": 0, "POLISH": 0})
TABLE_1 = (STURM, BISECTION, ONE_RAY, TWO_RAYS, NEWTON_5, NEWTON_3)
OURS_OF_TABLE_1 = (STURM_BY_SIGN, BISECTION_AT_BENDS, TWO_RAYS_AHEAD, NEWTON_5_FORWARDS, NEWTON_3_FORWARDS)

_MARCH = {"REFINEMENTS": 8, "EXPAND": 0, "BLOCK": 1, "SECANT": 0}
MARCH = Pick("ray marching", "ray_march", _MARCH)
MARCH_OURS = Pick("ray marching in blocks", "ray_march", {"REFINEMENTS": 12, "EXPAND": 1, "BLOCK": 8, "SECANT": 1})
_PRINTED = {"LAST": 0, "TOLERANCE": 2.0**-23, "START": 0, "SAMPLES": 0, "MATRIX": 0}
_FIT = _PRINTED | {"BASIS": 0, "EFT": 1, "EVAL": 1}
FIT = Pick("EFT + EVAL", "eft_yuksel", _FIT)
NO_EFT = Pick("EVAL without EFT", "eft_yuksel", _FIT | {"EFT": 0})
NO_EVAL = Pick("EFT without EVAL", "eft_yuksel", _FIT | {"EVAL": 0})
NEITHER = Pick("neither", "eft_yuksel", _FIT | {"EFT": 0, "EVAL": 0})
BERNSTEIN_NEITHER = Pick("neither, Bernstein", "eft_yuksel", _FIT | {"BASIS": 1, "EFT": 0, "EVAL": 0})
BERNSTEIN_NO_EVAL = Pick("EFT without EVAL, Bernstein", "eft_yuksel", _FIT | {"BASIS": 1, "EVAL": 0})
_OURS = {"LAST": 1, "TOLERANCE": 2.0**-18, "START": 1, "SAMPLES": 1, "MATRIX": 1}
FIT_OURS = Pick("our EFT + EVAL", "eft_yuksel", _FIT | _OURS)
FIT_CHANGES = (  # ours against what szente prints, one at a time
    Pick("Newton's steps to the root, not bisection of f", "eft_yuksel", _FIT | {"LAST": 1, "TOLERANCE": 2.0**-18}),
    Pick("Newton's method starts by a cubic, not in the middle", "eft_yuksel", _FIT | {"START": 1}),
    Pick("nothing looked for behind the samples' change of sign", "eft_yuksel", _FIT | {"SAMPLES": 1}),
    Pick("the inverse matrix in halves, nodes rounded first", "eft_yuksel", _FIT | {"MATRIX": 1}),
)
MARCH_CHANGES = (
    Pick("8 steps looked at together, not one", "ray_march", _MARCH | {"BLOCK": 8}),
    Pick("f's expansion to degree 4, not f", "ray_march", _MARCH | {"EXPAND": 1}),
)
YUKSEL = Pick("Yuksel on the expansion", "yuksel", {"START": 0})
_LU = {"BOUND": 1, "SIDES": 2, "CULL": 1, "LOCAL": 0, "TRUST": 0.0, "MATRIX": 0}
LU = Pick("LU bound", "lu_lipschitz", _LU)
CONTROL = Pick("control point bound", "lu_lipschitz", _LU | {"BOUND": 0, "CULL": 0})
LU_UNCULLED = Pick("LU bound without culling", "lu_lipschitz", _LU | {"CULL": 0})
LU_SUBINTERVALS = Pick("LU bound on subintervals", "lu_lipschitz", _LU | {"LOCAL": 2})
LU_OURS = Pick("our LU bound", "lu_lipschitz", {"BOUND": 1, "SIDES": 1, "CULL": 1, "LOCAL": 1, "MATRIX": 1})

UNIFORM = Pick("uniform", "interval_uniform", {"GROUPED": 1})
UNIFORM_IN_ROWS = Pick("uniform, row by row", "interval_uniform", {"GROUPED": 0})
ADAPTIVE = Pick("adaptive", "interval_adaptive", {"DESCENT": 0, "REMAP": 0})
REMAPPED = Pick("adaptive, remapped", "interval_adaptive", {"DESCENT": 0, "REMAP": 16})
ADAPTIVE_OURS = Pick("adaptive from the parent's piece", "interval_adaptive", {"DESCENT": 1, "REMAP": 0})

TORUS = ("torus",)
CUBICS = ("cayley", "clebsch", "ding_dong", "monkey_saddle", "whitney_umbrella", "cartan_umbrella")
TABLE_4 = ("sphere", "torus", "calyx", "barth_sextic", "endrass_octic", "barth_decic", "sixteen_ball")
TABLE_5 = ("sphere", "flirt", "calyx", "barth_sextic")
HIGH_DEGREE = ("endrass_octic", "barth_decic", "sixteen_ball")

POLYGONS = tuple(Pick(f"Polygon {n}*{n}", "polygon", {"N": n}) for n in (32, 64, 128, 256, 512))
