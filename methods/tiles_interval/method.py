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
interval with its derivatives, and one for f at the end of a piece. They cost very different numbers of operations, so
that rows tell no operations per evaluation.

**Speed** Median time of a frame in ms by the device's clock, opencl:intel, float32, on two cores of an AMD processor
without AVX-512: `firsthit run configs/tiles-any.toml` at 5112ea8, nothing beside it; 8 of its 40 cells were told to be
noisy. `python -m tests.benchmarks.tile_speed runs/tiles-any --method tiles_interval --over interval_march
interval_adaptive sphere_tracing ray_march` prints these figures. 9,216 rays of each surface are held against the
oracle: no clear ray is wrong, of this method, interval_march, ray_march and sphere_tracing.

    surface         pixels     this method  interval_march  interval_adaptive  sphere_tracing  ray_march  over march
    --------------  ---------  -----------  --------------  -----------------  --------------  ---------  ----------
    gyroid          512x512    92.2         545             121                -               1650       5.91
    blinn_blob      512x512    19.3         38.1            9.84               -               718        1.97
    torus_distance  512x512    11.4         27.6            9.00               2.82            53.3       2.42
    smooth_union    512x512    21.7         51.1            12.8               3.65            274        2.35
    gyroid          1024x1024  202          1870            440                -               5900       9.22
    blinn_blob      1024x1024  46.5         145             35.1               -               3140       3.12
    torus_distance  1024x1024  37.9         104             35.3               10.8            220        2.74
    smooth_union    1024x1024  54.0         190             47.0               13.4            1140       3.52

So it is 2.85 times as fast as interval_march at 512x512 in the mean, and 4.08 times at 1024x1024. interval_adaptive
answers for pixels, and is off by up to 0.05: 124 and 64 of its rays are wrong. It takes 0.75 and 1.07 times as long as
this method. sphere_tracing is three to six times as fast on distance functions, and off by up to 1.3e-3. The largest
errors here are those of pixels that interval_march casts, 5.6e-5 at most; those of all others are below 1e-5, which is
about STEP.

**What was tried** Processor time of opencl:intel at 512x512, float32, in ms, the least of seven frames; the first
figure is the gyroid's, the second that of torus_distance. Variants of one line were cast by turns.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    a tile is single only where all its rays have entered   of the gyroid's pixels 0.3 % are cast by            yes
      the domain before their roots                         interval_march, in place of 2.1 %
    a pixel whose longer piece is not monotone is halved    packets 31 / 5.3 to 70 / 20, the rest               no
      again before it is open                               40 / 2.1 to 27 / 1.2
    the same with PIECES = 2048 in place of 256             509 / 122, in place of 134 / 30                     no
    tiles down to 2 by 2 pixels, with that halving          125 / 28, in place of 105 / 17                      no
    tiles from 32, 16 and 8 pixels on, with that halving    136 / 27, 125 / 28, 131 / 27                        -
    a sine and a cosine that occur twice in the generated   136 / -, in place of 141 / -: the compiler finds    no
      function computed once                                them itself; the medians differ by 1 %
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
