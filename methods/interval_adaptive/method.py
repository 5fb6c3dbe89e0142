"""Beams over a quadtree of the image, so that large empty regions of it are discarded at once.

A beam is all the rays through a cell of the image. The kernel searches the beam of a cell in depth, as interval_uniform
does for one pixel. A cell whose beam is empty is background. Any other cell is split into four quarters, which are
searched at the next level, from the depth at which the cell's own search stopped. The last level's cells are pixels.

**Source** beamcasting, section III.C and procedures Subdivide and Adaptive; levels, queues and the first level: III.E;
anti-aliasing: III.D.

**Theory** A cell's beam contains the beams of its quarters. So what BeamCast excludes for the cell is excluded for its
quarters: if the beam is empty, all its pixels are background, and otherwise the quarters need not search in front of
the depth at which the cell's search stopped. ε, the depth at which BeamCast stops halving, is halved at each level: a
wide beam has wide boxes, which cannot bound f well however short they are in depth.

**Changes against the paper**
- DESCENT = 1 (default): a cell hands its quarters the place of its last piece in the binary tree of depths, as the
  integer that holds the path to it. The paper hands down a depth. The quarters go on from that piece instead of halving
  [w, far] anew, so that their pieces are those of interval_uniform. Both methods therefore give the same answers bit
  for bit, except for pieces that rounding tells apart.
- DESCENT = 0 (setting "Adaptive") is the paper's descent. Each quarter halves [w, far] anew, down to pieces less than ε
  deep, where w is the nearest depth of its parent's piece. w is kept in steps of 2^-23 of the depth T, rounded towards
  the eye. The paper prints no ε. With ours, ε = T √2 / 2^(level + BISECTIONS), where the whole image is level 0, pieces
  are 0.7 to 1.4 times as deep as interval_uniform's. Evaluations of interval_uniform over this method's at 256x256 are
  1.26 on the sphere and 1.72 on the tangle. With the largest and the smallest ε that leave interval_uniform's pieces as
  they are, they are 1.38 and 1.22 on the sphere, and 1.89 and 1.58 on the tangle.
- FIRST_LEVEL: the paper starts at the level that "fills the GPU". Here that is the first level with 1,024 cells for
  each compute unit of a GPU, or with one work group for each unit of a processor. FIRST_LEVEL sets another.
- GROUPED: the paper groups threads by the places of their beams, and does not say how. Here the first level's cells lie
  in Z order, which keeps neighbours together (row by row with GROUPED = 0), and the four quarters of a cell lie side by
  side.
- REMAP: remapping threads by the position of beams relative to the surface is the paper's future work. Ours puts the
  quarters of cells with a long search behind all others.
- The queue holds the cells that were not empty, as three integers each. Work items of the next level take their
  quarters from it, four neighbours at a time. The queue's length stays on the device: a fixed number of work items
  strides over it.
- The depth T, beams, boxes and shading are those of interval_uniform.

**Evaluations counted** Evaluations of f's interval extension. Those of a large beam are divided among the pixels below
it, as whole numbers that add up to what was spent.

**Speed** Time of interval_uniform over the time of this method, as printed, in the mean of twelve surfaces:
opencl:intel, float32, processor time.

    image, samples per pixel       here  the paper
    -----------------------------  ----  ---------
    512x512, 1                     1.69  1.38
    1024x1024, 1                   1.82  1.60
    512x512, 4                     1.81  1.81
    1024x1024, 4                   1.89  2.01

In evaluations the ratio is 0.9 to 3.7 as printed, and 1.2 to 6.7 with DESCENT = 1. Chmutov's septic, in the paper's
form, gains least: 0.9 to 1.0 in evaluations and 0.87 to 1.16 in time, where the paper has 1.5 to 1.9. The sphere comes
next: 1.3 to 1.4 in evaluations and 1.1 to 1.2 in time, where the paper has 1.3 to 1.8. Most of the sphere's pixels are
hit, so they halve the whole depth again at each level.

**What was tried** Processor time of opencl:intel at 512x512, float32, in ms, on both cores; the first figure is the
sphere's, the second the tangle's.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    FIRST_LEVEL from 2 to 8                                 21 to 25 / 63 to 73, no trend: the pixels' own      -
                                                            level decides
    evaluations of interval_uniform over this method's,     1.30, 1.29, 1.23 / 2.00, 1.94, 1.68                 -
      at first levels 4, 7 and 8, as printed
    the same with DESCENT = 1                               3.36, 3.05, 2.24 / 2.45, 2.33, 1.92: a first level  -
                                                            just above the pixels' keeps most of the gain
    REMAP = 16, as printed                                  0.98 to 1.04 times as fast on sphere, octdong,      no
                                                            steiner and tangle; of 32 lanes 23 to 42 % are
                                                            idle, not 27 to 44 %
    each level's queue sorted whole, by what the parent     17 to 59 % of lanes idle; in the best case, sorted  no
      spent or by its depth                                 by what its own items spend, 1 %. Where the
                                                            parent's search stopped says little of its
                                                            quarters' searches
    a cell's pixels painted by one loop at every level      22 / 63                                             no
    a path without loop and division at the pixels' level   21 / 61                                             yes
    DESCENT = 1 goes on at the halves of the parent's       5.4 / 13.2 evaluations per pixel, against           no
      piece, in place of the piece itself                   5.2 / 12.6: a quarter's beam often excludes the
                                                            whole piece
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="interval_adaptive",
    source="beamcasting",
    label="Interval beams, adaptive",
    needs=("surface_range",),
    parameters=(
        Parameter(
            "BISECTIONS",
            1,
            "depth of a level's last piece: the domain's depth / 2^(level + BISECTIONS); level 0 is the whole image",
        ),
        Parameter(
            "DESCENT",
            1,
            "where a quarter's search starts; 1: at its parent's last piece; 0: it halves [that piece's "
            "depth, far] anew",
            printed=0,
        ),
        Parameter(
            "FIRST_LEVEL",
            -1,
            "first level of the quadtree, at most the pixels' level; -1: the level whose cells fill the device",
        ),
        Parameter("GROUPED", 1, "order of the first level's cells over work items; 1: Z order; 0: row by row"),
        Parameter(
            "REMAP",
            0,
            "quarters of a cell whose search took more evaluations than this are searched last; 0: in the cells' order",
        ),
    ),
    settings={"Adaptive": {"DESCENT": 0}},
    claims=frozenset({"no_missed_root", "finds_touch"}),
    casts="quadtree",
)
