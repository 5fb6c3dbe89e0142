"""Beams over a quadtree of the image: large empty regions are thrown away at once.

**Source** beamcasting, section III.C and procedures Subdivide and Adaptive; levels, queues and where to start: III.E;
anti-aliasing: III.D.

**Theory** A large beam holds the beams of its quarters, so that what BeamCast excludes for it is excluded for them: a
cell of the image whose beam is empty is background, and the quarters of another need look no nearer than where its
search stopped. Each level halves ε, since the width of a beam bounds what its boxes can tell of its depth.

**Changes against the paper**
- DESCENT = 1: what a cell hands to its quarters is its place in the tree of depths, the integer that holds the path,
  instead of a depth alone. The quarters go on from that piece, do not halve [w, far] anew, and their pieces are those
  of the uniform method, so that both answer alike, bit for bit but for pieces that rounding tells apart.
- The setting "Adaptive", DESCENT = 0, is the paper's descent: each quarter halves [w, far] anew, w the nearest depth of
  its parent's piece, down to a piece less than ε deep. w is kept in 2^-23 of the depth T, rounded towards the eye. The
  paper prints no ε. With ε = T √2 / 2^(level + BISECTIONS) pieces are from 0.7 to 1.4 of the uniform method's; the
  largest and the smallest ε that leave the uniform method's pieces as they are change uniform over adaptive, in
  evaluations at 256 × 256, from 1.26 to 1.38 and 1.22 on the sphere, and from 1.72 to 1.89 and 1.58 on the tangle.
- The first level "fills the GPU" there; here it has 1,024 cells for each compute unit of a GPU, a work group for each
  unit of a processor. FIRST_LEVEL is another.
- Threads are grouped by their beams' places there, it is not said how. Here the first level's cells lie in Z order
  (GROUPED = 0: row by row) and the four quarters of a cell side by side. Remapping threads by where beams are to the
  surface is its plan; REMAP puts the quarters of cells that were searched for long after all others.
- The queue holds the cells that were not empty, three whole numbers each; a level's work items take their quarters from
  it, four neighbours at a time. Its length stays on the device: a fixed number of work items strides over it.
- Depth T, beams, boxes, shading: as in interval_uniform.

**Evaluations** A large beam's are divided among the pixels below it, in whole numbers that add up to what was spent.

**Against the paper's tables** opencl:intel, float32, processor time: uniform over adaptive as printed is 1.69 and 1.82
in the mean of twelve surfaces at 512 × 512 and 1024 × 1024, with 4 samples 1.81 and 1.89; the paper has 1.38, 1.60,
1.81 and 2.01. In evaluations it is 0.9 to 3.7, and 1.2 to 6.7 from the parent's piece. Chmutov's septic as the paper
writes it gains least: 0.9 to 1.0, in time 0.87 to 1.16, where the paper has 1.5 to 1.9. Then comes the sphere (1.3 to
1.4; in time 1.1 to 1.2, the paper 1.3 to 1.8), since most of its pixels are hit and halve all the depth again at each
level.

**Tried**, processor time of opencl:intel at 512 × 512, float32, as ms on both cores, sphere / tangle:
- The first level from 2 to 8: 21 to 25 / 63 to 73, no trend. What counts is the pixels' own level. Uniform over
  adaptive in evaluations at first levels 4, 7 and 8, as printed: 1.30, 1.29, 1.23 / 2.00, 1.94, 1.68; from the parent's
  piece 3.36, 3.05, 2.24 / 2.45, 2.33, 1.92: one level above the pixels' own keeps most of it.
- REMAP = 16, as printed: 0.98 to 1.04 times as fast on sphere, octdong, steiner and tangle; of 32 lanes 23 to 42 % are
  idle instead of 27 to 44 %. Sorting each level's queue whole, by what the parent spent or by its depth, leaves 17 to
  59 % idle, and its best case, each level sorted by what its items spend, 1 %: where a parent's search stopped tells
  little of its quarters'. Not kept.
- A cell's pixels painted by one loop at every level: 22 / 63; a path without loop and division for the pixels' level:
  21 / 61. Kept.
- Going on at the halves of the parent's piece instead of at that piece: 5.4 / 13.2 evaluations per pixel against
  5.2 / 12.6, since a quarter's beam often excludes the whole piece. Not kept.
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="interval_adaptive",
    source="beamcasting",
    needs=("surface_range",),
    parameters=(
        Parameter("BISECTIONS", 1, "ε: a level's last piece is the domain's depth / 2^(level + BISECTIONS)"),
        Parameter(
            "DESCENT", 1, "a quarter's search: 1 goes on at its parent's piece, 0 halves [w, far] anew", printed=0
        ),
        Parameter("FIRST_LEVEL", -1, "the first level, at most the pixels'; -1: the one whose cells fill the device"),
        Parameter("GROUPED", 1, "the first level's cells lie in Z order; 0: row by row"),
        Parameter("REMAP", 0, "quarters of a cell with more evaluations than this come after the others; 0: in turn"),
    ),
    settings={"Adaptive": {"DESCENT": 0}},
    claims=frozenset({"no_missed_root", "finds_touch"}),
    casts="quadtree",
)
