"""First roots by tiles: roots are isolated once for many rays, and each ray is finished alone.

The image is cut into tiles of 16 by 16 pixels. f is fitted in Bernstein form along the rays of 4 by 4 nodes of a tile,
and the coefficients are interpolated between them. Where all interpolated coefficients have one sign for certain, no
ray of the tile has a root. Where they change sign once, each ray has exactly one, and it is refined with f itself.

**Source** firsthit's own. It is made of these parts: beams that share the work of neighbouring rays (beamcasting); the
isolation of bernstein; bicubic interpolation with a bound of its remainder; Newton's method on f itself.

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
2. finish: in a single tile the nodes' roots and slopes are interpolated at each pixel. From there f itself decides: a
   few steps, and one by the mean of f over FIRST_PAIRS pairs of points, as in bernstein. Where f at these is far
   from a line, the mean is over PAIRS.
3. packets: the open tiles' pixels, 4 by 4 together. Each has its own fit and verdict, and only the halving is shared.
4. rest: what is still open, and roots whose last step leaves more than TOLERANCE, are cast by bernstein's kernel from
   the depth on that is known to be empty.

**What is promised** Verdicts of tiles hold for every ray wherever bernstein's promise holds. A hit is a place where the
computed value of f changes its sign between two points at which it was evaluated, so false hits occur on drowned rays
only.

**Changes against the paper** There is no paper.

**Evaluations counted** Evaluations of f for the pixel itself, and its share of those along the node rays of its tiles.

**Speed** Median time of a frame in ms by the device's clock, float32, 1024x1024, on two cores: `firsthit run
configs/tiles-1024.toml`. 9,216 rays of each surface are held against the oracle: no clear ray is wrong, of tiles nor of
bernstein; newton is wrong on some (450 misses on chmutov's). `largest` is the largest error of tiles over that of
bernstein on the same rays.

    surface       tiles  bernstein  eft_yuksel  newton  over bernstein  over eft_yuksel  largest
    ------------  -----  ---------  ----------  ------  --------------  ---------------  -------
    clebsch       1.97   4.79       4.15        2.72    2.4             2.1              1.2
    tangle        2.25   7.01       6.39        5.01    3.1             2.8              0.8
    torus         2.26   5.33       5.54        2.43    2.4             2.5              1.5
    calyx         4.73   7.91       7.66        5.45    1.7             1.6              0.8
    Barth sextic  3.58   10.9       12.8        7.39    3.0             3.6              0.9
    chmutov       5.68   9.64       14.7        3.91    1.7             2.6              0.9
    Endraß octic  11.7   22.4       31.4        11.7    1.9             2.7              1.3
    Barth decic   12.1   26.8       48.6        14.1    2.2             4.0              1.1
    16-ball       9.49   33.0       94.1        5.45    3.5             9.9              1.0

In the geometric mean it is 2.4 times as fast as bernstein and 3.1 times as fast as eft_yuksel. The table is of an older
kernel, on a processor with AVX-512. Two changes have been made since, each measured by interleaved runs on a busy
machine: bounds are looked up in coarser tables (0.94 times the time in the mean of the nine), and stages divide less
and use fused multiply-adds (0.96 times the processor time: calyx 0.93, decic 0.98 to 1.01).

On a processor without AVX-512, on which each method takes two to five times as long, the same config gave at acff067
2.4 times the speed of bernstein in the geometric mean (1.6 clebsch to 3.6 16-ball) and 3.2 times that of eft_yuksel
(1.3 clebsch to 11 16-ball); 20 of its 45 cells were told to be noisy. No clear ray of tiles was wrong.

What is known of the errors is in docs/tiles.md, "Errors beside bernstein's". The knobs AHEAD, PACKET_FITS, REFITS and
LEANS were chosen on these surfaces in this view.
Other devices, and frames of other sizes (configs/tiles.toml), have not been measured on a quiet machine.

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
    the mean of f over 8 pairs at uncertain roots, and      the frames: 1.02 times the time; the errors' 99.9   yes
      f's slope there held against the interpolated one     % over bernstein's: 1.03 to 0.85
    what is behind a tile's open piece is searched, so      octic: packets 0.96 times the time, isolation 1.1   no
      that packets may end there                            times; the frames: 1.02
    fewer divisions at each pixel, comparisons that are     finish: 0.85 times the time; the nine frames: 0.96  yes
      operators, fused multiply-adds in points, fits and
      interpolations (this row and those down to APART:
      processor time, interleaved, on a busy machine)
    FIRST_PAIRS = 1: two of the five evaluations of most    finish: 0.94 times the time, frames 1.00; the mean  no
      pixels less                                           is over three points in place of five
    STEP = 2^-16                                            frames 1.01 times the time                          no
    no first level: tiles of 8 pixels alone, where that     octic 0.99 times the time, decic 1.03: the first    no
      of 16 decides least (0.57 of the pixels)              level pays or is even on all nine surfaces
    APART = 4, as in bernstein, in place of 2               largest error over bernstein's, 320 views of five   yes
                                                            surfaces: 0.91 to 0.85; no other time
    pixels cast by themselves begin a piece earlier         largest error: heart 3 times as large, Cayley's     no
                                                            0.5 times

And on opengl:llvmpipe, where the stage that isolates is what takes long to compile: processor time of its compiler,
interleaved, the least of two or three on a busy machine.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    lanes are done row by row, so that Mesa unrolls four    torus 3.6 to 2.4 s, sextic 5.2 to 2.8, 16-ball 8.0  yes
      turns of the loops over lanes in place of sixteen,    to 6.7, a dense polynomial of degree 8 about 16 to
      and what lanes list is no array                       5; isolation at 512x512 0.89 to 1.1 times the time
    loops over lanes that are not unrolled at all           isolation of the 16-ball compiles in 22 s: arrays   no
                                                            that are indexed at run time; frames 1.12 to 1.35
    the transform across is done as rows are sampled        no sooner compiled                                  no
    minima and maxima by comparisons                        no sooner compiled                                  no
"""

from collections.abc import Mapping
from math import comb

from harness.contract import Method, Parameter, Precision, Surface

MAX_DEGREE = 20
SHELLS = 16  # balls about the domain's centre, each with its own bound of f's rounding errors
DEPTHS = 6  # halvings for which the tables say how errors grow
COORDINATES = 12.0  # error of a node ray's point, in unit roundoffs of its distance from the centre
REST = "of a pixel that is cast by itself:"


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.fitting import fit_tables, inverse
    from harness.kernels.rounding import sample_errors_grow, value_errors
    from harness.kernels.tiles import REACH

    assert surface.degree is not None
    matrix = inverse(surface.degree, "bernstein", precision)
    return fit_tables(surface.degree, "bernstein", precision) | {
        "TILE_ERRORS": list(value_errors(surface, SHELLS, COORDINATES, REACH)),
        "VALUE_ERRORS": list(value_errors(surface, SHELLS, 6.0)),
        "BINOMIALS": [float(comb(surface.degree, j)) for j in range(surface.degree + 1)],
        "COLUMNS": [max(float(abs(row[i])) for row in matrix) for i in range(surface.degree + 1)],
        "GROWTH": sample_errors_grow(surface.degree, precision, DEPTHS),
    }


def _accepts(surface: Surface) -> str | None:
    if surface.degree is None:
        return "not algebraic: along a ray it is no polynomial, which the fit would have to be"
    if 1 <= surface.degree <= MAX_DEGREE:
        return None
    return f"degree {surface.degree}: the fit is for degrees 1 to {MAX_DEGREE}"


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
        Parameter("STEP", 2.0**-18, "longest last step but one of the refinement, over the domain's diameter"),
        Parameter(
            "FIRST_PAIRS",
            2,
            "pairs of samples around the root, over which the last step takes the mean of f; 0: no such step",
        ),
        Parameter(
            "FIRST_APART",
            4.0,
            "distance between neighbouring samples of FIRST_PAIRS, in unit roundoffs of the domain's diameter",
        ),
        Parameter(
            "UNCERTAIN",
            8.0,
            "how far f at FIRST_PAIRS may be from a line before the mean is over PAIRS, in unit roundoffs of the "
            "domain's diameter",
        ),
        Parameter("PAIRS", 8, "pairs of samples around a root that is uncertain, or of a pixel that is cast by itself"),
        Parameter(
            "APART",
            4.0,
            "distance between neighbouring samples of PAIRS, in unit roundoffs of the domain's diameter; of a pixel "
            "that is cast by itself, of its ray's length in the domain",
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
    accepts=_accepts,
    tables=_tables,
)
