"""Hard cases: families of rays at which methods break, each a ladder along one parameter, with certified answers.

    from harness import hardcases
    for rung in hardcases.rungs("grazing"):
        truth = first_hits(rung.surface, rung.rays)
        verdict = judge_rung(rung, hits, truth, "float32")  # hardcases.verdict

A rung's rays are at its parameter as the float32 numbers they are, not before rounding: tests measure it again.
"""

from __future__ import annotations

from functools import cache

from harness.contract import FirsthitError
from harness.hardcases import polynomials, singular, tori
from harness.hardcases.model import Family, Rung
from surfaces.words import suggestion

__all__ = ["FAMILIES", "Family", "Rung", "get", "names", "rungs"]

FAMILIES: dict[str, Family] = {
    family.name: family
    for family in (
        tori.grazing,
        tori.torus_four_hits,
        tori.tangent_plane,
        singular.double_root,
        polynomials.clustered_roots,
        polynomials.flat_faces,
        polynomials.lower_degree,
        tori.torus_axis,
        tori.thin_torus,
        singular.horn_torus,
        singular.spindle_torus,
        singular.nodes_cayley,
        singular.nodes_kummer,
        singular.nodes_barth,
        singular.cusp,
        singular.double_line,
        tori.origin_on_surface,
        tori.origin_inside,
        tori.far_origin,
        polynomials.tiny_coefficients,
        polynomials.huge_coefficients,
    )
}


def names() -> tuple[str, ...]:
    """Every family's name, from the contact of ray and surface to the size of numbers."""
    return tuple(FAMILIES)


def get(name: str) -> Family:
    """A family by name; a FirsthitError with the nearest names where there is none."""
    if name not in FAMILIES:
        raise FirsthitError(f"there is no family of hard cases {name!r}; {suggestion(name, FAMILIES, most=3)}")
    return FAMILIES[name]


@cache
def rungs(name: str) -> tuple[Rung, ...]:
    """A family's ladder, going harder; a FirsthitError for an unknown name."""
    return get(name).make()
