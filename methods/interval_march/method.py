"""Interval bisection in depth along a ray, nearest half first.

**Source** beamcasting, section III (procedure BeamCast), with the beam shrunk to a ray.

**Theory** An interval extension of f over a piece of the ray encloses every value that f takes there. Where it excludes
zero the piece holds no root, touches included, and is passed; otherwise the piece is halved and its nearer half looked
at first. So no root is ever stepped over. The first piece no wider than TOLERANCE that cannot be excluded is the
answer: overestimation and roundoff can place it before a root, or where there is only nearly one.

**Changes against the paper**
- A ray instead of a pixel's beam: what is measured is a hit of the ray, as for the other ray methods.
- No recursion and no stack: after an excluded piece the next one starts twice as wide, after an undecided one half as
  wide. The paper keeps the path of a fixed binary tree in one integer; here pieces need not lie on a tree.
- The tolerance is a width in t over the domain's radius, not halved by level: a ray has no levels.

**Speed** Processor time on opencl:intel, float32, 512 x 512: without a check for overflow at every operation, where
harness/kernels/reach.py proves that there is none, with fma in outward rounding and constants as factors, 1.7 (decic)
to 2.1 times (sextic) faster. Rejected: a vector's 16 rays from 4 x 4 pixels (1.25 times faster here, see ray_march).
"""

from harness.contract import Method, Parameter

METHOD = Method(
    name="interval_march",
    source="beamcasting",
    needs=("surface_range_along",),
    parameters=(
        Parameter(
            "TOLERANCE",
            2.0**-20,
            "width of the final piece, over the domain's radius",
            finer="down",
            sweep=(2.0**-12, 2.0**-16, 2.0**-22),
            per="DOMAIN_RADIUS",
        ),
        Parameter("MAX_EVALUATIONS", 8192, "evaluations spent on one ray"),
    ),
    claims=frozenset({"no_missed_root", "finds_touch"}),
)
