"""Interval bisection in depth along a ray, nearest half first.

The kernel evaluates an interval extension of f over a piece of the ray. A piece over which it excludes 0 is passed, and
the next piece is twice as long. Any other piece is halved, and its nearer half is searched first. The first piece that
is no longer than TOLERANCE and cannot be excluded is the hit.

**Source** beamcasting, section III (procedure BeamCast), with the beam reduced to a ray.

**Theory** An interval extension of f over a piece encloses every value that f takes there. Where it excludes 0, the
piece holds no root and no touch. Nothing else is ever passed, so no root is missed. The converse does not hold:
overestimation and rounding can place the answer before a root, or where there is only nearly one. A piece that one jump
of f crosses is bounded on both sides of it alone (harness/kernels/ranges.py), so that a jump across 0 is no hit; where
two jumps meet in a last piece, it is one.

**Changes against the paper**
- A ray in place of a pixel's beam: as for the other ray methods, the answer is a hit of the ray.
- No recursion and no stack: after an excluded piece the next one begins twice as long, after an undecided one half as
  long. The paper keeps the path in a fixed binary tree in one integer. Here pieces need not lie on a tree.
- The tolerance is a length in t over the domain's radius. The paper halves it from level to level; a ray has no levels.

**Evaluations counted** Evaluations of f's interval extension.

**What was tried** Processor time on opencl:intel, float32, 512x512.

    what was tried                                              measured                              kept
    ----------------------------------------------------------  ------------------------------------  ----
    no check for overflow at each operation, where              1.7 (decic) to 2.1 times (sextic)     yes
      harness/kernels/reach.py proves that there is none; fma   faster
      in outward rounding; constants as factors
    the 16 rays of a vector from 4 by 4 pixels                  1.25 times faster here, see           no
                                                                ray_march
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="interval_march",
    source="beamcasting",
    label="Interval marching",
    needs=("surface_range_along",),
    parameters=(
        Parameter(
            "TOLERANCE",
            2.0**-20,
            "length of the last piece, over the domain's radius",
            finer="down",
            sweep=(2.0**-12, 2.0**-16, 2.0**-22),
            per="DOMAIN_RADIUS",
        ),
        Parameter(
            "MAX_EVALUATIONS",
            8192,
            "evaluations of f's interval extension on one ray, after which the ray is exhausted",
        ),
    ),
    claims=frozenset({"no_missed_root", "finds_touch"}),
)
