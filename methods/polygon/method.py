"""Triangles in place of rays: the parametric form over N × N points, drawn by ordinary rasterisation.

**Source** toledo2007, section 5 and Table 1 (Polygon N*N): what ray casting is held against.

**Theory** The points lie on the surface; between them triangles cut the corner. With N rings and N sides the ring's own
chord leaves 1 - cos(π/N) of R + r, as the paper prints. Where both chords add, at facet centres near the outer equator,
(R + 2 r) (1 - cos(π/N)) are left.

**Changes against the paper**
- Vertices carry the surface's normals, triangles are indexed, instances are drawn by one call.
- Spheres, cylinders, cones and planes are a stated extension.
"""

from harness.contract import MeshRecipe, Method, Parameter, Surface


def accepts(surface: Surface) -> str | None:
    from harness.scenes.meshes import parametric_refusal

    return parametric_refusal(surface)


METHOD = Method(
    name="polygon",
    source="toledo2007",
    parameters=(Parameter("N", 64, "points around, in either direction", finer="up"),),
    settings={f"Polygon {n}*{n}": {"N": n} for n in (32, 64, 128, 256, 512)},
    accepts=accepts,
    precisions=("float32",),
    casts="mesh",
    mesh=lambda _surface, knobs: MeshRecipe("parametric", int(knobs["N"])),
)
