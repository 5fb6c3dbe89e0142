"""draft"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface


def _tables(surface: Surface, knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.fitting import derivative_factors

    assert surface.degree is not None
    return {"FACTORS": derivative_factors(surface.degree, "monomial")}


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not a polynomial: it has no coefficients along a ray"
    return None if 1 <= surface.degree <= 4 else f"degree {surface.degree}: exact coefficients are for 1 to 4"


METHOD = Method(
    name="yuksel",
    source="szente",
    needs=("surface_coefficients_along",),
    libraries=("dual", "polynomial"),
    parameters=(
        Parameter("TOLERANCE", 2.0**-18, "last Newton step, over the length of the ray's span in the domain"),
        Parameter("ISOLATION", 2.0**-10, "the same for the derivatives' roots"),
    ),
    accepts=_accepts,
    tables=_tables,
)
