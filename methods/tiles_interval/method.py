"""First roots of any f by tiles: intervals isolate roots for many rays at once, and each ray is finished alone.

The image is cut into tiles of 16 by 16 pixels. The rays of a tile fill a pyramid, and pieces of it between two depths
are searched from the near end on. f and its three derivatives are enclosed by intervals over a box around a piece.
Where f excludes 0, no ray of the tile has a root in the piece. Where f falls, or rises, along all rays, and has one
sign at the near end and the other at the far end, each ray has exactly one. Its root is then refined with f itself.

**Source** firsthit's own. It is made of these parts: beams that share the work of neighbouring rays and are cut into
quarters (beamcasting); roots isolated by the sign of a derivative's interval (Mitchell, Robust ray intersection with
interval arithmetic, 1990); the frames of `tiles`.

**Theory** Let D be a ray's direction at depth 1, M that of the tile's middle ray, and A and B the two sides of the
tile, halved. Then D = M + u A + v B with u and v in [-1, 1], and for a fixed depth s a ray's point is s (u A + v B)
away from the middle ray's. G, an interval for each derivative of f over a box around the piece, gives intervals of
the derivatives along M, A and B. By the mean value theorem, which holds across kinks as the box's derivatives hold
those of both sides:
- f at a ray's point differs from f at the middle ray's point of the same depth by at most s (|G A| + |G B|).
- f on the middle ray is above a line from either end of the piece, whose slopes are the ends of G M. If the lowest
  point of both lines is farther from 0 than that, the piece is empty for all rays.
- f is strictly monotone along all rays if G M, widened by |G A| + |G B|, excludes 0.

A piece that is not decided is halved. Where f falls along all rays and only the far end is not behind all roots, the
piece is made longer, by as much as the flattest slope needs. A tile whose shortest piece is not decided is open. It
is cut into quarters, down to 4 by 4 pixels; pixels of open tiles are searched as tiles of their own. The square of a
tile reaches 1/32 pixel beyond the middles of its pixels, and all roundings of the geometry are bounded and added, so
verdicts hold for listed rays as for computed ones (docs/tiles.md).

Where f may jump in a box, no derivatives are known there (harness/kernels/gradient_ranges.py): f's interval can still
show that the piece is empty, and nothing there is single. A tile whose rays may have their roots before they enter
the domain is not single either. A root behind the domain is none.

What is still open is cast by interval_march's kernel, from the depth on that is known to be empty.

**What is promised** No tile's verdict passes a root, and interval_march passes none. A hit in a single tile or pixel
is a root at which f is proved to change its sign. Pixels that are cast by themselves are hit wherever interval_march
would hit them, which may be where there is only nearly a root: so `no_false_hit` is not claimed.

**Changes against the paper** There is no paper. It is a method beside `tiles`, and no setting of that: here there are
no samples, no lanes that share a tile and no table of bounds, another method casts the rest, and the claims are
stronger. Both cast frames of tiles, whose kind, check and part of the report they share.

**Evaluations counted** Evaluations of f for the pixel itself, and its share of those for its tiles: one for f's
interval with its derivatives, and one for f at the end of a piece.
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
        Parameter(
            "STEP",
            2.0**-20,
            "longest last step of a root's refinement, over the domain's diameter; never less than 4 unit roundoffs",
            finer="down",
            sweep=(2.0**-8, 2.0**-12, 2.0**-16),
            per="2.0 * DOMAIN_RADIUS",
        ),
        Parameter("STEPS", 24, "most steps of a root's refinement, before the pixel is cast by itself"),
        Parameter("FIRST", 0.25, "length of the first piece, over that of a tile's rays in the domain"),
        Parameter("SHORTEST", 2.0, "shortest piece of a tile, over the tile's side"),
        Parameter("FINEST", 2.0**-16, "shortest piece of a pixel that is searched as a tile, over the domain's radius"),
        Parameter("GROWTHS", 3, "how often a piece in which f falls along all rays is made longer"),
        Parameter("PIECES", 256, "most pieces of a tile or a pixel, before it is open"),
        Parameter("TOLERANCE", 2.0**-20, f"{REST} length of the last piece, over the domain's radius"),
        Parameter(
            "MAX_EVALUATIONS",
            8192,
            f"{REST} evaluations of f's interval extension, after which it is exhausted",
        ),
    ),
    claims=frozenset({"no_missed_root", "finds_touch"}),
)
