"""First roots of any f by tiles: intervals isolate roots for many rays at once, and each ray is finished alone.

**Source** firsthit's own.

**Theory** to be written.
"""

from harness.contract import Method, Parameter

REST = "of a pixel that is cast by itself:"

METHOD = Method(
    name="tiles_interval",
    source="firsthit",
    label="Tiles by intervals",
    casts="tiles",
    rest="interval_march",
    needs=("surface_value", "surface_range_along", "surface_gradient_range"),
    parameters=(
        Parameter("STEP", 2.0**-20, "longest last step of a root's refinement, over the domain's diameter"),
        Parameter("STEPS", 24, "most steps of a root's refinement, before the pixel is cast by itself"),
        Parameter("FIRST", 0.25, "length of the first piece, over that of a tile's rays in the domain"),
        Parameter("SHORTEST", 2.0, "shortest piece of a tile, over the tile's side"),
        Parameter("FINEST", 2.0**-12, "shortest piece of a pixel that is searched as a tile, over the domain's radius"),
        Parameter("GROWTHS", 3, "how often a piece in which f falls along all rays is made longer"),
        Parameter("PIECES", 256, "most pieces of a tile or a pixel, before it is open"),
        Parameter("TOLERANCE", 2.0**-20, f"{REST} length of the last piece, over the domain's radius"),
        Parameter("MAX_EVALUATIONS", 8192, f"{REST} evaluations of f's interval extension, after which it is exhausted"),
    ),
    claims=frozenset({"no_missed_root", "finds_touch"}),
)
