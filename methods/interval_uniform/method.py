"""Interval bisection in depth on the beam of every pixel.

A beam is all the rays through a pixel. The kernel evaluates an interval extension of f over a box around a piece of the
beam. A piece over which it excludes 0 is dropped. Any other piece is halved in depth, and its nearer half is searched
first, down to pieces of depth ε. The first such piece that cannot be excluded is the pixel's answer.

**Source** beamcasting, sections III.A and III.B and procedures BeamCast and Uniform; the integer in place of a stack:
III.E.

**Theory** A piece of a beam lies between two depths, and a box in world coordinates contains it. The interval extension
of f over that box encloses every value that f takes on the piece. Where it excludes 0, or where the box lies outside
the domain, no ray of the pixel meets the surface there. So no root of any ray of the pixel is passed, and no touch. The
converse does not hold, for three reasons: the beam may meet what its middle ray passes by; the box is larger than the
piece; the extension overestimates, the more its operations depend on each other. The answer is the middle of the first
piece that cannot be excluded, as a distance along the pixel's middle ray.

**Changes against the paper**
- A beam is a perspective frustum: all rays of the camera through a pixel. The paper's is a right prism in image space,
  of a camera that it does not print.
- Nothing is shaded: a pixel gets its distance, status and evaluations. The paper's frames per second include a kernel
  that shades by the gradient, and drawing the picture.
- The depth T spans the domain: the diameter of a ball, or a box's extent along the view direction. The paper's T = [-1,
  1] belongs to its own scenes.
- ε follows the resolution: the last pieces are T / 2^(level + BISECTIONS) deep, where the smallest square of 2^level
  pixels a side that holds the image gives the level. With BISECTIONS = 1 a piece is about half as deep as a pixel is
  wide. The paper sets a constant that it does not print.
- The paper's text lets BeamCast stop also where it can prove that the beam sees the surface. The paper's procedures do
  not, and neither do ours.
- GROUPED: pixels lie over work items in Z order (row by row with GROUPED = 0). The paper takes U and V from the indexes
  of threads in a 2D grid, whose blocks it does not print, and has "tried" to group threads by the places of their
  beams.
- Boxes are cut by the domain, which clips the surface here. A box outside the domain costs no evaluation.
- Boxes are rounded outward, in float32 or float64. The beam is wider than its pixel by sixteen float32 roundings, so
  that rays made on any device are in it.
- After an excluded piece, the next piece is the other half of the nearest ancestor of which only one half has been
  searched. The trailing ones of the integer give it, so the search spends no steps on going up the tree.

**Evaluations counted** Evaluations of f's interval extension.

**What was tried** Processor time of opencl:intel at 512x512, float32, in ms, on both cores. Figures with slashes are
those of sphere / tangle / barth_sextic, or of the first two.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    beams as vec3                                           73 on the sphere: the driver does not vectorise     no
                                                            them
    beams as vec3, with intel_vec_len_hint(16): 16 pixels   42 / 110 / 127                                      no
      to a vector
    beams by components: 8 pixels to a vector, without a    36 / 100                                            yes
      hint
    beams by components, with the hint, which is one        31 / 92, but interval_adaptive slows from 16 / 55   no
      vendor's                                              to 19 / 59
    f evaluated for every lane, outside the domain too, in  46 / 107 / 122 against 42 / 110 / 127;              no
      place of a branch                                     interval_adaptive loses 3 to 20 %
    what depends on the camera alone computed once for      38 / 103 / 122                                      yes
      each work item, in place of once for each beam
    ranges without a check for overflow at each operation   1.3 (sphere) to 1.8 times (barth_sextic) faster;    yes
      (harness/kernels/reach.py), outward rounding by fma,  interval_adaptive too
      constants as factors
    pixels row by row (GROUPED = 0), over Z order           1.10 to 1.17 times the time on sphere, octdong,     no
                                                            steiner and tangle. Of 8 lanes that run in step
                                                            11 to 15 % are idle, not 7 to 11 %; of 32 lanes
                                                            31 to 42 %, not 15 to 22 %
                                                            (configs/beamcasting-divergence.toml)
    work groups of 256, over 64                             1.01 here; 1.08 for Newton on the torus: kept for   yes
                                                            the cheaper methods
    the search begins at 2, 4, 8 or 16 pieces, in place of  at 8 pieces 45 / 97, against 36 / 105 on sphere /   no
      the whole beam, whose range always holds 0 where      tangle: fewer evaluations, but no less time
      there is a surface
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="interval_uniform",
    source="beamcasting",
    label="Interval beams, uniform",
    needs=("surface_range",),
    parameters=(
        Parameter(
            "BISECTIONS",
            1,
            "depth of the last piece: the domain's depth / 2^(n + BISECTIONS), for an image of at most "
            "2^n pixels a side",
        ),
        Parameter("GROUPED", 1, "order of pixels over work items; 1: Z order; 0: row by row"),
    ),
    claims=frozenset({"no_missed_root", "finds_touch"}),
    casts="beams",
)
