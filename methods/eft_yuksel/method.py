"""draft"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface


def _tables(surface: Surface, knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.fitting import derivative_factors, fit_tables

    assert surface.degree is not None
    basis = "bernstein" if knobs["BASIS"] == 1 else "monomial"
    return fit_tables(surface.degree, basis, precision) | {"FACTORS": derivative_factors(surface.degree, basis)}


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not algebraic"
    return None if 1 <= surface.degree <= 20 else "degree"


METHOD = Method(
    name="eft_yuksel",
    source="szente",
    needs=("surface_value",),
    libraries=("dual", "fit", "polynomial"),
    parameters=(
        Parameter("BASIS", 0, "0: monomial, 1: Bernstein"),
        Parameter("EFT", 1, ""),
        Parameter("EVAL", 1, ""),
        Parameter("ISOLATION", 2.0**-10, ""),
        Parameter("TOLERANCE", 2.0**-18, ""),
    ),
    accepts=_accepts,
    tables=_tables,
)
