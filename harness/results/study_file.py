"""Declare studies/<key>.json: the rows of each study of harness/studies, which reports read."""

# Without `from __future__ import annotations`: on texts TypedDict does not see which members are NotRequired.

from pathlib import Path
from typing import Annotated, Any, Literal, TypedDict

from harness.results import declared, sealed, store
from harness.results.declared import NOT_NEGATIVE, SHARE


class ConditionNumber(TypedDict):
    """Hold the condition number of the fit in a basis, of a degree."""

    basis: str
    degree: int
    condition: Annotated[float, NOT_NEGATIVE]


class ExtremaBound(TypedDict):
    """Hold the error of a bound on polynomials of a degree, percent."""

    reading: str
    bound: str
    degree: int
    percent: float


class FormRange(TypedDict):
    """Hold how wide the interval extension of a form is on boxes of a size."""

    surface: str
    form: str
    side: Annotated[float, NOT_NEGATIVE]
    factor: float
    empty: int
    excluded: Annotated[float | None, SHARE]


class MeshError(TypedDict):
    """Hold how far the mesh of a torus is from it."""

    n: int
    ring: float
    both: float
    to_surface: float
    to_mesh: float
    vertices: int
    triangles: int
    bytes: int


class TorusCase(TypedDict):
    """Hold what a torus's polynomial does along one ray."""

    case: str
    coefficients: list[float]
    t_m: float
    roots: list[float]
    extremes: list[float]
    bends: list[float]


class TorusRays(TypedDict):
    """Hold what a torus's polynomial does along sampled rays."""

    case: Literal["sampled"]
    rays: int
    minima: int
    maxima: int
    mean_error: float
    equation_error: float


ROWS: dict[str, Any] = {
    "condition_numbers": list[ConditionNumber],
    "extrema_bounds": list[ExtremaBound],
    "form_ranges": list[FormRange],
    "mesh_errors": list[MeshError],
    "torus_along_rays": list[TorusCase | TorusRays],
}


def _case(row: dict[str, Any]) -> str | None:
    return "its coefficients are not five" if len(row["coefficients"]) != 5 else None


_CHECKS = {name: declared.checker(kind, {TorusCase: _case}) for name, kind in ROWS.items()}


def read(path: Path, name: str, key: str) -> dict[str, Any]:
    """Read the file of a study, and hold it against its checksum and its declaration. Raises OSError or ValueError."""
    stored = store.of_format(sealed.read(path), store.FORMAT)
    for member, expected in (("study", name), ("key", key)):
        if stored.get(member) != expected:
            raise ValueError(f"its {member} is {stored.get(member)!r:.40}, not {expected}")
    if name not in _CHECKS:
        raise ValueError(f"no study is called {name!r:.40}")
    _CHECKS[name](stored.get("rows"), "rows")
    return stored
