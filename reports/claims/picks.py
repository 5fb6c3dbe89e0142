"""Name the settings of methods that claims are about: the papers' own, ours, and those that differ in one knob.

What the methods state is not repeated here: `printed` takes a paper's setting by its name, `ours` takes defaults.
"""

from reports.claims.evidence import Pick
from reports.claims.stated import ours, printed

_STARTS = ours("newton", ("STEP_BOUND", "SPHERE_START"))  # the paper's values are the defaults
_NEWTON_3, _NEWTON_5 = (printed("newton", name) | _STARTS for name in ("Newton 0.001", "Newton 0.00003"))
NEWTON_3 = Pick("Newton 0.001", "newton", _NEWTON_3)
NEWTON_5 = Pick("Newton 0.00003", "newton", _NEWTON_5)
NEWTON_UNBOUND = Pick("Newton with steps up to 100", "newton", _NEWTON_3 | {"STEP_BOUND": 100})
NEWTON_FROM_BOX = Pick("Newton 0.001 from the box", "newton", _NEWTON_3 | {"SPHERE_START": 0})
_FORWARDS = _STARTS | ours("newton", ("FORWARD",))
_FORWARDS_3, _FORWARDS_5 = (_FORWARDS | {"EPSILON": knobs["EPSILON"]} for knobs in (_NEWTON_3, _NEWTON_5))
NEWTON_3_FORWARDS = Pick("Newton 0.001 forwards", "newton", _FORWARDS_3)
NEWTON_5_FORWARDS = Pick("Newton 0.00003 forwards", "newton", _FORWARDS_5)
FORWARDS_UNBOUND = Pick("steps forwards up to 100", "newton", _FORWARDS_3 | {"STEP_BOUND": 100})
FORWARDS_FROM_BOX = Pick("forwards from the box", "newton", _FORWARDS_3 | {"SPHERE_START": 0})
_STURM = printed("sturm", "Sturm") | ours("sturm", ("DISCARD",))
STURM = Pick("Sturm", "sturm", _STURM)
STURM_FROM_EYE = Pick("Sturm from the eye", "sturm", _STURM, "eye")
STURM_SEARCHING = Pick("Sturm that discards after its search", "sturm", _STURM | {"DISCARD": 0})
STURM_SHORT = Pick("Sturm with 8 halvings", "sturm", _STURM | {"ITERATIONS": 8})
STURM_BY_SIGN = Pick("Sturm by sign", "sturm", ours("sturm", ("BY_SIGN",)) | {"ITERATIONS": _STURM["ITERATIONS"]})
_BISECTION = printed("double_derivative_bisection", "D.D. Bisection")
BISECTION = Pick("D.D. Bisection", "double_derivative_bisection", _BISECTION)
BISECTION_AT_BENDS = Pick(
    "D.D. Bisection at f'' = 0",
    "double_derivative_bisection",
    _BISECTION | ours("double_derivative_bisection", ("SPLIT",)),
)
_ONE_RAY = printed("sphere_tracing", "Sphere Tracing")
_TWO_RAYS = printed("sphere_tracing", "2-rays S. Tracing")
# AHEAD says how the second ray steps: with one ray any value is the same method
ONE_RAY = Pick("Sphere Tracing", "sphere_tracing", {name: _ONE_RAY[name] for name in ("RAYS", "EPSILON")})
TWO_RAYS = Pick("2-rays S. Tracing", "sphere_tracing", _TWO_RAYS)
TWO_RAYS_AHEAD = Pick("2-rays S. Tracing ahead", "sphere_tracing", _TWO_RAYS | ours("sphere_tracing", ("AHEAD",)))
_LOOP_BLINN = printed("analytic", "Loop-Blinn")
LOOP_BLINN = Pick("Loop-Blinn", "analytic", _LOOP_BLINN)
BETWEEN_PLANES = Pick(
    "Loop-Blinn between close planes", "analytic", _LOOP_BLINN | {"SCREEN": 1, "NEAR": 2.5, "FAR": 6.0}
)
CLOSED_FORM = Pick("a closed form", "analytic")
TABLE_1 = (STURM, BISECTION, ONE_RAY, TWO_RAYS, NEWTON_5, NEWTON_3)
OURS_OF_TABLE_1 = (STURM_BY_SIGN, BISECTION_AT_BENDS, TWO_RAYS_AHEAD, NEWTON_5_FORWARDS, NEWTON_3_FORWARDS)

_MARCH = printed("ray_march", "ray marching")
MARCH = Pick("ray marching", "ray_march", _MARCH)
MARCH_OURS = Pick("ray marching in blocks", "ray_march", ours("ray_march", _MARCH))
_FIT = printed("eft_yuksel", "EFT + EVAL") | ours("eft_yuksel", ("BASIS",))  # monomial
FIT = Pick("EFT + EVAL", "eft_yuksel", _FIT)
NO_EFT = Pick("EVAL without EFT", "eft_yuksel", _FIT | printed("eft_yuksel", "EVAL"))
_NO_EVAL, _NEITHER = (_FIT | printed("eft_yuksel", name) for name in ("EFT", "no EFT"))
NO_EVAL = Pick("EFT without EVAL", "eft_yuksel", _NO_EVAL)
NEITHER = Pick("neither", "eft_yuksel", _NEITHER)
_BERNSTEIN = printed("eft_yuksel", "Bernstein")
BERNSTEIN_NEITHER = Pick("neither, Bernstein", "eft_yuksel", _NEITHER | _BERNSTEIN)
BERNSTEIN_NO_EVAL = Pick("EFT without EVAL, Bernstein", "eft_yuksel", _NO_EVAL | _BERNSTEIN)
FIT_OURS = Pick("our EFT + EVAL", "eft_yuksel", ours("eft_yuksel", _FIT))
FIT_CHANGES = tuple(  # ours against what szente prints, one at a time
    Pick(words, "eft_yuksel", _FIT | ours("eft_yuksel", knobs))
    for words, knobs in (
        ("Newton's steps to the root, not bisection of f", ("LAST", "TOLERANCE")),
        ("Newton's method starts by a cubic, not in the middle", ("START",)),
        ("nothing looked for behind the samples' change of sign", ("SAMPLES",)),
        ("the inverse matrix in halves, nodes rounded first", ("MATRIX",)),
    )
)
MARCH_CHANGES = tuple(
    Pick(words, "ray_march", _MARCH | ours("ray_march", knobs))
    for words, knobs in (
        ("8 steps looked at together, not one", ("BLOCK",)),
        ("f's expansion to degree 4, not f", ("EXPAND",)),
    )
)
YUKSEL = Pick("Yuksel on the expansion", "yuksel", printed("yuksel", "Yuksel"))
_LU = printed("lu_lipschitz", "LU bound")
LU = Pick("LU bound", "lu_lipschitz", _LU)
CONTROL = Pick("control point bound", "lu_lipschitz", printed("lu_lipschitz", "control point"))
LU_UNCULLED = Pick("LU bound without culling", "lu_lipschitz", _LU | {"CULL": 0})
LU_SUBINTERVALS = Pick("LU bound on subintervals", "lu_lipschitz", printed("lu_lipschitz", "LU bound on subintervals"))
LU_OURS = Pick("our LU bound", "lu_lipschitz", ours("lu_lipschitz", ("BOUND", "SIDES", "CULL", "LOCAL", "MATRIX")))

UNIFORM = Pick("uniform", "interval_uniform", ours("interval_uniform", ("GROUPED",)))
UNIFORM_IN_ROWS = Pick("uniform, row by row", "interval_uniform", {"GROUPED": 0})
_ADAPTIVE = printed("interval_adaptive", "Adaptive") | ours("interval_adaptive", ("REMAP",))
ADAPTIVE = Pick("adaptive", "interval_adaptive", _ADAPTIVE)
REMAPPED = Pick("adaptive, remapped", "interval_adaptive", _ADAPTIVE | {"REMAP": 16})
ADAPTIVE_OURS = Pick("adaptive from the parent's piece", "interval_adaptive", ours("interval_adaptive", _ADAPTIVE))

TORUS = ("torus",)
CUBICS = ("cayley", "clebsch", "ding_dong", "monkey_saddle", "whitney_umbrella", "cartan_umbrella")
TABLE_4 = ("sphere", "torus", "calyx", "barth_sextic", "endrass_octic", "barth_decic", "sixteen_ball")
TABLE_5 = ("sphere", "flirt", "calyx", "barth_sextic")
BEAM_SURFACES = {  # of beamcasting's tables, with the names that it gives them
    "sphere": "Sphere",
    "dingdong_beamcasting": "Dingdong",
    "klein": "Klein",
    "mitchell": "Mitchell",
    "octdong": "Octdong",
    "steiner": "Steiner",
    "tangle": "Tangle",
    "teardrop": "Teardrop",
    "barth_sextic": "Barth",
    "heart": "Heart",
    "chmutov": "Chmutov",
    "blinn_blob": "Blob",
}
HIGH_DEGREE = ("endrass_octic", "barth_decic", "sixteen_ball")

POLYGONS = tuple(
    Pick(name, "polygon", printed("polygon", name)) for name in (f"Polygon {n}*{n}" for n in (32, 64, 128, 256, 512))
)
