"""Compute how far a polygonal torus is from the torus (toledo2007, Table 1, last columns).

The paper prints 1 - cos(π/N) as a share of R + r, which is the error of a polygon along the ring. The polygon around
the tube has an error too. At the centres of facets near the outer equator both add up to (R + 2 r) (1 - cos(π/N)). Both
formulas are computed, and the mesh's distances are measured in both directions.
"""

from __future__ import annotations

import math

TITLE = "Errors of polygonal tori"
SIZES = (32, 64, 128, 256, 512)


def compute() -> list[dict[str, int | float]]:
    """Return a row for each N; without pyvista there are none.

    A row has n; ring and both, the formulas, and to_surface and to_mesh, the measured distances, all over R + r; and
    the mesh's vertices, triangles and bytes.
    """
    import surfaces
    from harness.contract import MeshRecipe
    from harness.scenes import meshes

    torus = surfaces.get("torus")
    ring, tube = (float(dict(torus.parameters)[name]) for name in ("R", "r"))
    rows: list[dict[str, int | float]] = []
    for n in SIZES if meshes.missing() is None else ():
        made = meshes.mesh(torus, MeshRecipe("parametric", n))
        to_surface, to_mesh = meshes.geometric_error(torus, made)
        chord = 1.0 - math.cos(math.pi / n)
        rows.append(
            {
                "n": n,
                "ring": chord,
                "both": (ring + 2.0 * tube) * chord / (ring + tube),
                "to_surface": to_surface / (ring + tube),
                "to_mesh": to_mesh / (ring + tube),
                "vertices": len(made.vertices),
                "triangles": len(made.triangles),
                "bytes": made.vertices.nbytes + made.triangles.nbytes,
            }
        )
    return rows
