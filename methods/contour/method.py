"""Triangles in place of rays: the surface's contour on a regular grid, drawn by ordinary rasterisation.

**Source** W. E. Lorensen, H. E. Cline, Marching cubes, 1987; flying edges as VTK has it (W. Schroeder, R. Maynard,
B. Geveci, Flying edges: a high-performance scalable isocontouring algorithm, 2015).

**Theory** f is known at the grid's points; along each edge where its sign changes a linear guess places a vertex. What
is thinner than a cell, or touches zero without crossing it, is lost.

**Changes against the paper** Normals are f's gradients. A ball's domain clips the triangles.
"""

from harness.contract import MeshRecipe, Method, Parameter

METHOD = Method(
    name="contour",
    source="Lorensen and Cline 1987",
    parameters=(Parameter("CELLS", 64, "cells along the longest side of the domain's box", finer="up"),),
    precisions=("float32",),
    casts="mesh",
    mesh=lambda _surface, knobs: MeshRecipe("contour", int(knobs["CELLS"])),
)
