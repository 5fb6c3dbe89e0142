"""Interval bisection in depth on the beam of every pixel.

**Source** beamcasting, sections III.A and III.B and procedures BeamCast and Uniform; the integer in place of a stack:
III.E.

**Theory** A beam is every ray of a pixel, a piece of it lies between two depths, and a box in world coordinates holds
the piece. f's interval extension over that box encloses every value that f takes on the piece. Where it excludes zero,
or the box lies outside the domain, no ray of the pixel meets the surface there. Otherwise the piece is halved in depth
and its nearer half looked at first, down to pieces ε deep. So no root of any ray of the pixel is stepped over, touches
included. The converse does not hold: the beam may touch what its middle ray passes by, the box is larger than the
piece, and the extension overestimates, more so the more its operations depend on one another. What is told is the
middle of the first piece that cannot be excluded, as a distance along the pixel's middle ray.

**Changes against the paper**
- A beam is a perspective frustum, all rays of the camera through a pixel; there it is a right prism in image space, of
  a camera that is not printed.
- Nothing is shaded: a pixel gets its distance, status and evaluations. The paper's frames per second include a kernel
  that shades by the gradient, and drawing the picture.
- The depth T spans the domain as far as this domain does: a ball its diameter, a box what it measures along the view.
  The paper's T = [-1, 1] is of its own scenes.
- ε follows the resolution: the last pieces are T / 2^(level + BISECTIONS) deep, where 2^level pixels are a side of the
  smallest square that holds the image. With BISECTIONS = 1 a piece is about half as deep as a pixel is wide. The paper
  sets a constant that it does not print.
- The paper's text also lets BeamCast stop where it can prove that the beam sees the surface. Its procedures do not, and
  none of this does.
- Pixels lie over work items in Z order. The paper takes U and V from the indexes of threads in a 2D grid, whose blocks
  it does not print, and "tried" to group threads by their beams' places; GROUPED = 0 is row by row.
- Boxes are cut by the domain, which clips the surface here, and what lies outside it costs no evaluation. Boxes are
  rounded outward, in float32 or float64; the beam is wider than its pixel by sixteen float32 roundings, so that rays
  made on any device are in it.
- After an excluded piece the next one is the nearest ancestor's other half, found from the integer's trailing ones, so
  that the search costs no step upwards.

**Tried**, processor time of opencl:intel at 512 × 512, float32, as ms on both cores, sphere / tangle / barth_sextic:
- Beams as vec3 keep the driver from vectorising: 73 ms on the sphere. It can be made to, sixteen pixels to a vector, by
  `intel_vec_len_hint(16)`: 42 / 110 / 127. By components it does so by itself, eight to a vector: 36 / 100. Kept,
  without the hint, which is one vendor's: with it 31 / 92, but the adaptive method slows from 16 / 55 to 19 / 59.
- f evaluated for every lane, also outside the domain, instead of under a branch: 46 / 107 / 122 against 42 / 110 / 127.
  Not kept, since the adaptive method loses 3 to 20 % by it.
- What depends on the camera alone computed once per work item instead of once per beam: 38 / 103 / 122. Kept.
- Ranges without a check for overflow at every operation (harness/kernels/reach.py), outward rounding by fma, constants
  as factors: 1.3 (sphere) to 1.8 times (barth_sextic) faster, interval_adaptive alike. Kept.
- Pixels row by row (GROUPED = 0) instead of in Z order: 1.10 to 1.17 times the time on sphere, octdong, steiner and
  tangle. Of 8 lanes that run in step 11 to 15 % are idle instead of 7 to 11 %, of 32 lanes 31 to 42 % instead of 15 to
  22 % (`configs/beamcasting-divergence.toml`). Kept in Z order.
- Work groups of 256 instead of 64: 1.01. Kept, for the cheaper methods' sake: 1.08 for Newton on the torus.
- The search started at 2, 4, 8 or 16 pieces instead of the whole beam, whose range always holds zero where there is a
  surface: 45 / 97 at 8 pieces against 36 / 105 on sphere / tangle, fewer evaluations but no less time. Not kept.
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="interval_uniform",
    source="beamcasting",
    needs=("surface_range",),
    parameters=(
        Parameter("BISECTIONS", 1, "ε: the last piece is the domain's depth / 2^(the pixels' level + BISECTIONS)"),
        Parameter("GROUPED", 1, "pixels lie over work items in Z order; 0: row by row"),
    ),
    claims=frozenset({"no_missed_root", "finds_touch"}),
    casts="beams",
)
