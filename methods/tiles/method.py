"""First roots by tiles: roots are isolated once for many rays, and each ray is finished alone.

The image is cut into tiles of 16 by 16 pixels. f is fitted in Bernstein form along the rays of 4 by 4 nodes of a tile,
and the coefficients are interpolated between them. Where all interpolated coefficients have one sign for certain, no
ray of the tile has a root. Where they change sign once, each ray has exactly one, and it is refined with f itself.

**Source** firsthit's own. It is made of these parts: beams that share the work of neighbouring rays (beamcasting); the
isolation of bernstein; bicubic interpolation with a bound of its remainder; Newton's method on f itself; compensated
arithmetic (szente, and harness/kernels/glsl/tiles/compensated.glsl).

**Theory** docs/tiles.md proves what the verdicts say. For a fixed depth the point on a ray is an affine function of the
ray's place in the image. So f along all rays of a tile is a polynomial of depth and place, and what its interpolation
in place leaves out is bounded by f's fourth derivatives, which the host bounds over the cells of a grid in exact and
directed arithmetic (harness/kernels/fourths.py). The bound grows in a piece's coefficients as errors of samples do
(GROWTH). Bounds of rounding errors are those of bernstein, times what interpolation makes of them.

A frame takes four stages, and nothing comes back to the host between them:
1. isolate: tiles of 16 pixels, and then those of 8 that cover the open ones, are searched from the near end on, by
   halving and depth first. A tile is empty, single (every ray has its first root in one piece, and no other root
   there) or open. A tile whose roots lie at too many depths for one piece is tried once more with nodes in planes that
   lean as the surface does (LEANS).
   At the rim, where the domain cuts the surface, a single tile is searched behind its piece too.
2. finish: in a single tile the nodes' roots and slopes are interpolated at each pixel. From there f itself decides, by
   its mean over FIRST_PAIRS pairs of points around the interpolated root. Where f at these is no line as far as
   roundings tell (UNCERTAIN), Newton steps follow if the root is far away, and in the end f is computed with
   compensated arithmetic, which keeps the rounding error of each operation: one step by such a value, or a few secants.
3. packets: the open tiles' pixels, 4 by 4 together. Each has its own fit and verdict, and only the halving is shared.
4. rest: what is still open, and roots whose last step leaves more than TOLERANCE, are cast by bernstein's kernel from
   the depth on that is known to be empty. Their roots are corrected by compensated values of f too.

**What is promised** Verdicts of tiles hold for every ray wherever bernstein's promise holds. A hit is a place where the
computed value of f, plain or compensated, changes its sign between two points at which it was evaluated, so false hits
occur on drowned rays only.

**Changes against the paper** There is no paper.

**Evaluations counted** Evaluations of f for the pixel itself, and its share of those along the node rays of its tiles.
A compensated one counts once, and has five to six times the operations of a plain one; in GLSL, where fused products
are not exact on every device, 13 times.

**Speed** Median time of a frame in ms by the device's clock, float32, 1024x1024, on two cores of an Intel Xeon with
AVX-512: `firsthit run configs/tiles.toml --device opencl:intel` with prepass = ["none"], one interleaved run of four
sizes at b7d74c64. `python -m tests.benchmarks.tile_speed runs/tiles` prints these figures. 16,384 rays of each surface
are held against the oracle: no clear ray is wrong, of tiles nor of bernstein and eft_yuksel; newton is wrong on 1,538.
`largest` is the largest error of tiles over that of bernstein on the same rays. Ratios are of the rounds that timed
both, and times are medians of all rounds.

    surface       tiles  bernstein  eft_yuksel  newton  over bernstein  over eft_yuksel  largest
    ------------  -----  ---------  ----------  ------  --------------  ---------------  -------
    clebsch       2.87   9.39       8.95        4.96    3.19            3.01             0.191
    tangle        4.38   16.3       15.6        10.1    3.7             3.56             0.175
    torus         4.21   11.7       12.4        4.81    2.54            2.68             0.104
    Kummer        7.18   16.2       15.4        9.23    2.93            2.77             0.127
    flirt         4.19   13.4       13.6        8.49    3.3             3.27             0.583
    calyx         5.45   14.1       15          9.26    2.59            2.71             0.0869
    Barth sextic  5.64   18.1       24.5        12.3    3.22            4.34             0.0905
    Klein bottle  3.31   12.9       17.2        9.33    3.92            5.22             0.227
    heart         4.02   13.5       19.7        11      3.32            4.63             0.238
    chmutov       7.14   15.5       27.4        6.62    2.17            3.8              0.065
    Endraß octic  18.1   35         61.2        20.6    2.06            3.6              0.0598
    Barth decic   16.1   39.6       86          22.6    2.43            5.35             0.0597
    16-ball       12     52.5       182         10.3    4.24            14               0.766

The larger the frame, the more it gains. Geometric means of the thirteen surfaces:

    pixels     over bernstein  least of them  over eft_yuksel  over newton
    ---------  --------------  -------------  ---------------  -----------
    512x512    2.02            1.52           2.66             1.07
    1024x1024  2.98            2.06           4.04             1.60
    2048x2048  3.74            2.65           5.18             2.02
    4096x4096  4.19            3.08           5.87             2.28

Its time grows as the pixels to the power 0.79 in the mean (0.68 sextic to 0.89 16-ball), bernstein's to the power 0.96.
49 of the run's 260 cells drifted and 16 were noisy. The same run at 206c8d87, the commit before, in which 12 drifted
and 4 were noisy, gave 2.13, 3.05, 3.79 and 4.25 over bernstein, and 2.83, 4.17, 5.26 and 5.99 over eft_yuksel. On two
cores of an AMD processor without AVX-512 the means over bernstein were 2.29, 3.35, 4.06 and 4.31 at these sizes, and
over eft_yuksel 2.75, 4.07, 5.04 and 5.42, at 1fe7ee7, before the rows "a work item takes" and "whether a mask holds"
below.

On opencl:pocl, there too and at b7d74c64, configs/tiles-1024.toml gave 11.1 over bernstein (7.56 octic to 16.7
16-ball), 13.8 over eft_yuksel and 6.07 over newton. At a8430e6, before the rows "f with compensated arithmetic" and "a
work item takes", configs/tiles.toml gave 13.9 over bernstein (9.05 at least) and 17.0 over eft_yuksel at 2048x2048, and
16.4 (11.2) and 19.8 at 4096x4096. No clear ray of tiles, bernstein and eft_yuksel is wrong.

What is known of the errors is in docs/tiles.md, "Errors beside bernstein's". The knobs AHEAD, PACKET_FITS, REFITS and
LEANS were chosen on nine of these surfaces in this view.

**What was tried** opencl:intel, processor time at 1024x1024, float32, mostly single runs on a busy machine:

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    one bound of fourth derivatives a cell, for all         the 16-ball's packets take 9.0 ms in place of 2.7:  no
      directions                                            the bound is 240 times too large there
    vectors of sixteen numbers vectorised once more by      the three stages of the 16-ball compile in 10 s,    no
      Intel's compiler (no vec_type_hint)                   in place of 1.1 s, and are no faster
    blocks of open pixels fitted anew (PACKET_FITS)         the decic's last stage: 5.6 to 3.4 ms               yes
    the same up to 16 times                                 the octic's packets: 9 to 17 ms                     no
    a piece that ends where the roots of all nodes are      1 % fewer open pixels, and no faster                no
      passed, before a tile is open
    the frame before as a start: pieces of single tiles,    torus 1.06, sextic 0.99 times as fast after 6       no
      and open tiles cut at once (512x512)                  degrees; 1.06 and 1.05 if nothing moves
    tiles of 32 first, for four samples a pixel             sextic 14.2 to 14.4 ms, decic 45.5 to 44.3          no
    planes that lean as the surface does                    16-ball: 22 to 18 ms; the octic's open pixels: 28   yes
      to 21 % and no faster
    no look-up of bounds up to degree 4, and coarser        frames of the nine: 0.93 times the time; isolation  yes
      tables first up to degree 8 (this row and the next    alone from 0.56 (clebsch) to 0.7 (chmutov)
      three: interleaved runs on a busy machine)
    coarser tables first at every degree                    16-ball's isolation: 1.17 times the time            no
    what is behind a tile's open piece is searched, so      octic: packets 0.96 times the time, isolation 1.1   no
      that packets may end there                            times; the frames: 1.02
    fewer divisions at each pixel, comparisons that are     finish: 0.85 times the time; the nine frames: 0.96  yes
      operators, fused multiply-adds in points, fits and
      interpolations (this row and those down to
      "begin a piece earlier": processor time,
      interleaved, on a busy machine)
    FIRST_PAIRS = 1: two of the five evaluations of most    four surfaces: 0.95 times the time; the errors'     no
      pixels less                                           99.9 % over bernstein's in 40 views: 0.79 to 0.87
    STEP = 2^-16                                            frames 1.01 times the time                          no
    no first level: tiles of 8 pixels alone, where that     octic 0.99 times the time, decic 1.03: the first    no
      of 16 decides least (0.57 of the pixels)              level pays or is even on all nine surfaces
    pixels cast by themselves begin a piece earlier         largest error: heart 3 times as large, Cayley's     no
                                                            0.5 times
    a tile at the domain's rim is searched behind its       flirt 0.73, Kummer 0.89, clebsch 0.90, torus 1.02   yes
      piece too (this row and those down to PACKET_FITS:    times the time of a frame, calyx 1.01
      the device's clock, interleaved, nothing beside it)
    a block asks for its rays' ends in the domain only      six surfaces: 0.97 times the time                   yes
      where a root is not well inside
    no work item for each pixel of the frame in the last    torus: that stage 0.24 to 0.03 ms                   yes
      stage, but as many as keep the processor busy
    blocks of eight pixels in place of sixteen, for         six surfaces: 1.05 times the time                   no
      finish and packets
    pixels cast by themselves begin with a quarter of       five surfaces: 0.98 times the time; with a          no
      their ray in place of all of it                       sixteenth 1.03
    one step by the mean of f over two pairs of points      eight surfaces: refinement 0.76 to 0.91 of the      yes
      around the interpolated root, where f is a line as    time, frames 0.92 (flirt 0.84, octic 0.98); errors
      far as roundings tell, in place of a step by one      over bernstein's in 150 views: 0.81 to 0.80 (99.9
      value of f and another by a mean                      %), 0.77 to 0.76 (largest)
    rays that keep their depth as parameter, and have no    torus and clebsch, busy machine: refinement 0.96    no
      direction of length 1                                 and 0.98 of the time
    f with compensated arithmetic where roundings hide the  nine surfaces: 0.99 times the time (torus 1.12,     yes
      root, in place of means over 16 pairs (this row and   chmutov 0.75); errors over bernstein's in 150
      the next six: a Xeon with AVX-512, interleaved)       views: 0.76 to 0.08 (99.9 %), 0.70 to 0.02
                                                            (largest)
    UNCERTAIN = 4 in place of 2                             0.97 times the time; errors over bernstein's in 54  no
                                                            views of nine other surfaces: 0.34 to 0.49, 0.11
                                                            to 0.20, and one of them above 1
    means over 8, 16 and 32 pairs at uncertain roots, and   1, 1.01 and 1.03 times the time; errors over        no
      no compensated value                                  bernstein's in 60 views: 0.80, 0.76 and 0.74
                                                            (99.9 %), 0.87, 0.77 and 0.73 (largest)
    a work item takes up to 16 tiles from the counter that  torus: isolation 0.75, frame 0.88 times the time;   yes
      all share, and empty tiles are answered by vectors    octic's frame 0.95
    whether a mask holds in any lane is asked by the        torus and octic, with the row before: frame 0.81    yes
      compiler's own reduction (kortest), not by OpenCL's   and 0.87 times the time; octic's packets alone
      any and all (a tree of shuffles)                      0.77
    largest and sum of lanes by halves, not by memory       three surfaces: as fast                             no
    PACKET_FITS = 2, 3 and 6                                0.95 to 1.08, 0.93 to 1.06, 0.99 to 1.04            no
    packets fitted from the tile's net, by restriction      not built: sampling and fitting each block twice    no
                                                            makes the packets' stage 1.09 times as long at
                                                            most, and it is 0.5 of a frame at most

And on opengl:llvmpipe, where the stage that isolates is what takes long to compile: processor time of its compiler on a
busy machine, the least of two or three interleaved runs, some of them single ones. Most of what is left is LLVM's code
generation: two thirds, and the allocation of registers a quarter, for the 16-ball in float64.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    lanes are done row by row, so that Mesa unrolls four    torus 3.6 to 2.4 s, sextic 5.2 to 2.8, 16-ball 8.0  yes
      turns of the loops over lanes in place of sixteen,    to 6.7 or no gain, float64 sextic 13 to 6.1, dense
      and what lanes list is no array                       polynomial of degree 8 about 16 to 5; isolation at
                                                            1024x1024 takes 0.76 to 0.94 times the time
    loops over lanes that are not unrolled at all, whose    isolation of the 16-ball compiles in 22 s: arrays   no
      numbers are in arrays                                 that are indexed at run time; frames 1.12 to 1.35
    the transform across is done as rows are sampled        no sooner compiled while the loop over columns is   no
                                                            unrolled
    (this row and the next four: isolation, interleaved)    torus 0.78, sextic 0.78, 16-ball 0.83 of the time   yes
      far halves are made anew from the whole piece, in
      place of a stack, which is an array
    nothing is unrolled and nothing is an array: queues     with the row before: torus 2.3 to 1.4 s, 16-ball    yes
      of lanes and of rows; a column of the control net a   7.3 to 2.9, the octic 0.51 of the time; frames at
      turn; what the rays differ by is found lane by        512x512 0.90 to 1.01 of the time, all bits alike
      lane; weights and bounds of derivatives without a
      loop
    and SAMPLE is a loop where f is long (LONGEST)          dense polynomial of degree 16 0.69, of degree 8     yes
                                                            0.9 of the time; isolation takes 1.1 and 1.0
                                                            times as long, still 0.9 of what it was
    LONGEST = 200 or 800 in place of 600                    degree 16: 0.97 and 1.0 times as long to compile    no
    queues are set to 0, so that no turn of an outer loop   no sooner compiled                                  no
      depends on the one before
    minima and maxima by comparisons                        no sooner compiled                                  no
"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface
from harness.kernels.fitting import cannot_be_fitted

COORDINATES = 12.0  # error of a node ray's point, in unit roundoffs of its distance from the centre
REST = "of a pixel that is cast by itself:"


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.isolating import SHELLS, isolation_tables
    from harness.kernels.rounding import value_errors
    from harness.kernels.tiles import REACH

    tile_errors = value_errors(surface, SHELLS, COORDINATES, REACH)
    return isolation_tables(surface, precision) | {"TILE_ERRORS": list(tile_errors)}


METHOD = Method(
    name="tiles",
    source="firsthit",
    casts="tiles",
    rest="bernstein",
    needs=("surface_value",),
    libraries=("dual", "fit", "polynomial", "fit_samples"),
    parameters=(
        Parameter(
            "TOLERANCE",
            2.0**-51,
            "error that the refinement's last step leaves by its own estimate, over the domain's diameter; never less "
            "than 4 unit roundoffs",
            finer="down",
            sweep=(2.0**-8, 2.0**-12, 2.0**-18),
            per="2.0 * DOMAIN_RADIUS",
        ),
        Parameter("STEP", 2.0**-17, "longest last step but one of the refinement, over the domain's diameter"),
        Parameter(
            "FIRST_PAIRS",
            2,
            "pairs of points around the root, over which the first step and the last one take the mean of f, 1 or more",
        ),
        Parameter(
            "FIRST_APART",
            4.0,
            "distance between neighbouring points of FIRST_PAIRS, but for the last pair, in unit roundoffs of the "
            "domain's diameter",
        ),
        Parameter(
            "UNCERTAIN",
            2.0,
            "how far f at FIRST_PAIRS may be from a line before it is computed with compensated arithmetic, in unit "
            "roundoffs of the domain's diameter",
        ),
        Parameter(
            "SECANT",
            8.0,
            "distance of the first two points of a secant through compensated values of f, in unit roundoffs of the "
            "domain's diameter",
        ),
        Parameter("STEPS", 6, "most steps of the refinement of a pixel, before it is cast by itself"),
        Parameter("TRUST", 0.015625, "share of the worst case of the rounding errors that counts as their bound"),
        Parameter("HALVINGS", 6, "halvings of a fitted piece before a tile or a block is open"),
        Parameter("WIDENING", 8.0, "length of the next piece to be fitted, over that of the piece just decided"),
        Parameter("REFITS", 1, "how often a tile that is open is fitted anew before its quarters are"),
        Parameter("PACKET_FITS", 4, "fits of a block of open pixels before those still open are cast by themselves"),
        Parameter(
            "AHEAD", 4.0, "length of the first piece that is fitted in an open tile's parts, over the open piece"
        ),
        Parameter("LEANS", 1, "1: an open tile is tried once more with nodes in planes that lean as the surface does"),
        Parameter("SHORTEST", 2.0, "shortest piece of a tile, over the tile's side"),
        Parameter(
            "PAIRS", 2, f"{REST} pairs of points over which bernstein's last step takes the mean of f; 0: no such step"
        ),
        Parameter(
            "APART",
            4.0,
            f"{REST} distance of neighbouring points of PAIRS, in unit roundoffs of its ray's length in the domain",
        ),
        Parameter("TRUSTED", 4, f"{REST} halvings of a fitted piece before what is still open is fitted anew"),
        Parameter(
            "COUNTED", 5, f"{REST} highest degree at which sign changes of coefficients and samples are compared"
        ),
        Parameter("COMPENSATED", 17, f"{REST} lowest degree at which the fit uses compensated products and sums"),
        Parameter(
            "NOISE", 4.0, f"{REST} error bounds below which a fitted piece is decided by the signs of f's samples"
        ),
        Parameter("FITS", 64, f"{REST} fits after which the signs of f's samples decide what is open"),
        Parameter("MAX_EVALUATIONS", 4096, f"{REST} evaluations of f, after which it is exhausted"),
    ),
    claims=frozenset({"no_false_hit"}),
    accepts=cannot_be_fitted,
    tables=_tables,
)
