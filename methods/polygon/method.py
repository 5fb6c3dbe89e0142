"""Triangles in place of rays: the parametric form over N × N points, drawn by ordinary rasterisation.

The surface's parametric form is evaluated at N × N points, which become a mesh of triangles. The mesh is made once,
before anything is timed, and then drawn. No ray is cast: kernel.glsl only gives normals.

**Source** toledo2007, section 5 and Table 1 (Polygon N*N), to which the paper compares its ray casting.

**Theory** The points lie on the surface, and the triangles between them cut its corners. On a torus with N rings and N
sides, the chord of the ring alone leaves an error of 1 - cos(π/N) of R + r, as the paper prints. The chord of the tube
adds to it. The largest error is at the centres of facets near the outer equator: (R + 2 r) (1 - cos(π/N)).

**Changes against the paper**
- Vertices carry the surface's normals, triangles are indexed, and one call draws all instances.
- Spheres, cylinders, cones and planes are an extension of ours.
"""

from harness.contract import MeshRecipe, Method, Parameter, Surface


def accepts(surface: Surface) -> str | None:
    """Say why the surface has no parametric mesh; None if it has one."""
    from harness.scenes.meshes import parametric_refusal

    return parametric_refusal(surface)


METHOD = Method(
    name="polygon",
    source="toledo2007",
    label="Polygon mesh",
    parameters=(
        Parameter("N", 64, "points of the mesh around the surface, in each of its two directions", finer="up"),
    ),
    settings={f"Polygon {n}*{n}": {"N": n} for n in (32, 64, 128, 256, 512)},
    accepts=accepts,
    precisions=("float32",),
    casts="mesh",
    mesh=lambda _surface, knobs: MeshRecipe("parametric", int(knobs["N"])),
)
