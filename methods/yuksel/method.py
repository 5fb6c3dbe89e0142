"""Yuksel's root finding on the exact expansion of f along the ray, for degrees 1 to 4.

The kernel expands f along the ray as a polynomial. The roots of its derivative cut the ray into pieces on which the
polynomial is monotone. In the first piece at whose ends it differs in sign, Newton's method finds the root.

**Source** C. Yuksel, High-performance polynomial root finding for graphics, 2022, as szente, section 2.2, uses it.

**Theory** As in eft_yuksel: the first root lies between two critical points at which the polynomial differs in sign,
and the critical points are found in the same way, from the derivative of degree 2 up, whose roots have a formula. Here
the coefficients are expanded from the formula of f, so nothing is fitted, and all later steps use this expansion alone.
It cancels where roots are many or clustered; for such rays see the refinement on f itself in eft_yuksel.

**Changes against the paper**
- Degree 4 at most, since exact coefficients are generated to this degree. Nothing is fitted, and the last steps are
  Newton's, on the expansion. What szente changes in Yuksel's method is in eft_yuksel.
- szente prints no tolerance for it. TOLERANCE and ISOLATION are ours.
- START: Newton's method starts where a cubic that is level at both ends of a piece has its root; as printed, in the
  middle.

**Evaluations counted** Evaluations of the expanded f at the ends of pieces and in the last refinement; none of its
derivatives.

**What was tried** Processor time on opencl:intel, float32, 512x512, on torus, flirt, Kummer quartic and Cayley cubic.
eft_yuksel takes 1.3 to 1.8 times as long there. See its page too: both share the library `polynomial`.

    what was tried                                                  measured                            kept
    --------------------------------------------------------------  ----------------------------------  ----
    the quadratic derivative's roots by formula, over Newton's      saves 7, 12, 10 and 28 %            yes
      method from the linear derivative up
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
        Parameter(
            "ISOLATION", 2.0**-10, "last Newton step of the roots of derivatives, over the ray's length in the domain"
        ),
        Parameter(
            "START",
            1,
            "where Newton's method starts in a piece; 1: at the root of a cubic that is level at both "
            "ends; 0: in the middle",
            printed=0,
        ),
    ),
    settings={"Yuksel": {"START": 0}},
    claims=frozenset({"no_false_hit"}),
    accepts=_accepts,
    tables=_tables,
)
