"""draft"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface


def _tables(surface: Surface, knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.fitting import fit_tables

    assert surface.degree is not None
    return fit_tables(surface.degree, "bernstein", precision)


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not algebraic"
    return None if 1 <= surface.degree <= 20 else "degree"


METHOD = Method(
    name="lu_lipschitz",
    source="szente",
    needs=("surface_value",),
    libraries=("interval", "fit", "dual", "polynomial", "lu"),
    parameters=(
        Parameter("BOUND", 1, ""),
        Parameter("CULL", 1, ""),
        Parameter("LOCAL", 1, ""),
        Parameter("TOLERANCE", 2.0**-16, ""),
        Parameter("MAX_EVALUATIONS", 10000, ""),
    ),
    accepts=_accepts,
    tables=_tables,
)
