"""Make hard cases: families of hard rays, at which methods break.

A *family* of hard rays varies one number, its parameter, and keeps everything else. The parameter's values, in order of
rising difficulty, are the family's *ladder*; each value, with its surface and its rays, is a *rung*. These are all the
words that the project uses for hard cases.

    from harness import hardcases
    for rung in hardcases.rungs("grazing"):
        truth = first_hits(rung.surface, rung.rays)
        verdict = judge_rung(rung, hits, truth, "float32")  # harness.accuracy.rungs

The float32 rays themselves have the parameter that their rung states, not only the numbers that were rounded to them.
Tests measure it again, exactly.
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
    """Return the names of all families, in the order of FAMILIES."""
    return tuple(FAMILIES)


def get(name: str) -> Family:
    """Return a family by name. Raises FirsthitError, with the nearest names, if there is none."""
    if name not in FAMILIES:
        raise FirsthitError(f"there is no family of hard rays {name!r}; {suggestion(name, FAMILIES, most=3)}")
    return FAMILIES[name]


@cache
def rungs(name: str) -> tuple[Rung, ...]:
    """Return the rungs of a family's ladder, from easy to hard. Raises FirsthitError for an unknown name."""
    return get(name).make()
