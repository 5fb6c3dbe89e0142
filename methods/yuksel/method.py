"""Yuksel's root finding on the exact expansion of f along the ray.

**Source** C. Yuksel, High-performance polynomial root finding for graphics, 2022, as szente, section 2.2, uses it.

**Theory** As in eft_yuksel: the first root lies between two critical points where the ends differ in sign, and critical
points are found alike from the quadratic derivative up, by formula. Here the coefficients are expanded from the
formula, so nothing is fitted, and everything after that is done on the expansion alone. It cancels where roots are many
or clustered; eft_yuksel's refinement on f itself is for such rays.

**Changes against the paper**
- Degree 4 at most, where exact coefficients are generated. Nothing is fitted, and the last steps are Newton's, on the
  expansion: what szente changes in Yuksel's method is in eft_yuksel.
- szente prints no tolerance for it: TOLERANCE and ISOLATION are ours.
- START: Newton's method starts where a cubic that is level at both ends would put it; as printed, in the middle.

Evaluations counted are those of the expanded f, at ends of pieces and in the last refinement; none of its derivatives.

**Speed** See eft_yuksel: both share the library `polynomial`. Processor time on opencl:intel, float32, 512 x 512,
torus, flirt, Kummer quartic, Cayley cubic: the quadratic derivative by formula, instead of Newton's method from the
linear one up, saves 7, 12, 10 and 28 %. eft_yuksel takes 1.3 to 1.8 times as long there.
"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 4


def _tables(surface: Surface, _knobs: Mapping[str, float | int], _precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.fitting import derivative_factors

    assert surface.degree is not None
    return {"FACTORS": derivative_factors(surface.degree, "monomial")}


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not algebraic: it has no coefficients along a ray"
    if 1 <= surface.degree <= MAX_DEGREE:
        return None
    return f"degree {surface.degree}: exact coefficients along a ray are for degrees 1 to {MAX_DEGREE}"


METHOD = Method(
    name="yuksel",
    source="szente",
    needs=("surface_coefficients_along",),
    libraries=("dual", "polynomial"),
    parameters=(
        Parameter(
            "TOLERANCE",
            2.0**-18,
            "last Newton step of the root, over the ray's length in the domain",
            finer="down",
            sweep=(2.0**-8, 2.0**-12, 2.0**-22),
            per="2.0 * DOMAIN_RADIUS",
        ),
        Parameter("ISOLATION", 2.0**-10, "last Newton step of the derivatives' roots, likewise"),
        Parameter("START", 1, "Newton's first x: 1: by a cubic that is level at both ends, 0: the middle", printed=0),
    ),
    settings={"Yuksel": {"START": 0}},
    claims=frozenset({"no_false_hit"}),
    accepts=_accepts,
    tables=_tables,
)
