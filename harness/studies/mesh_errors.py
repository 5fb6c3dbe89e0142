"""How far a polygonal torus is from the torus (toledo2007, Table 1, last columns).

The paper prints 1 - cos(π/N) of R + r: the chord of the ring. The tube has a chord too; where both add, at facet
centres near the outer equator, (R + 2 r) (1 - cos(π/N)) are left. Both are computed, and the mesh is measured, both
ways.
"""

from __future__ import annotations

import math
from typing import Any

TITLE = "Errors of polygonal tori"
SIZES = (32, 64, 128, 256, 512)


def compute() -> list[dict[str, Any]]:
    """One row for each N: n, ring and both (the formulas), to_surface and to_mesh (measured), all over R + r; vertices,
    triangles and bytes of the mesh. Without pyvista, no rows."""
    import surfaces
    from harness.contract import MeshRecipe
    from harness.scenes import meshes

    torus = surfaces.get("torus")
    ring, tube = (float(dict(torus.parameters)[name]) for name in ("R", "r"))
    rows = []
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
