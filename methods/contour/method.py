"""Triangles in place of rays: the surface's contour on a regular grid, drawn by ordinary rasterisation.

f is evaluated at the points of a grid over the domain's box, and the contour f = 0 becomes a mesh of triangles. The
mesh is made once, before anything is timed, and then drawn. No ray is cast: kernel.glsl only gives normals.

**Source** W. E. Lorensen, H. E. Cline, Marching cubes, 1987; flying edges as VTK has it (W. Schroeder, R. Maynard, B.
Geveci, Flying edges: a high-performance scalable isocontouring algorithm, 2015).

**Theory** On each edge of the grid at whose ends f differs in sign, linear interpolation places a vertex. A part of the
surface that is thinner than a cell, or that touches zero without crossing it, is lost.

**Changes against the paper**
- Normals are the gradients of f.
- The triangles are clipped by the domain where it is a ball.
"""

from harness.contract import MeshRecipe, Method, Parameter

METHOD = Method(
    name="contour",
    source="Lorensen and Cline 1987",
    label="Contour mesh",
    parameters=(Parameter("CELLS", 64, "grid cells along the longest side of the domain's box", finer="up"),),
    precisions=("float32",),
    casts="mesh",
    mesh=lambda _surface, knobs: MeshRecipe("contour", int(knobs["CELLS"])),
)
