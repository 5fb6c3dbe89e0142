"""Sphere tracing by the surface's own distance, with one start or two.

**Source** toledo2007, section 4.3 (Sphere Tracing and 2-rays S. Tracing of Table 1), after Hart 1996.

**Theory** No surface is nearer to a point than its distance, so a step of that length never passes a root. Near a
tangency distances are small for long, and steps with them. On the torus a second start helps: along a line the
distance to the core circle takes every value at most four times (equation 2 has four roots for every r), so it has at
most two minima. Once the distance grows, the first minimum is behind, and the march goes on from t_M = -(o·v) towards
the other one; once it grows there after it fell, both are behind and there is no root.

**Changes against the paper**
- Two starts, AHEAD = 1: a first march that has passed t_M goes on where it is, and the second march ends once its
  distance has fallen and grows again, since no third minimum is left. AHEAD = 0 starts at t_M whatever was passed, and
  ends where the first march ends, as printed: at the domain's exit, or as exhausted after MAX_EVALUATIONS. A second
  start inside the torus turns back to the root behind it, as the signed distance does.
- A start inside the surface marches by the distance's absolute value, and has no second start.
- Any surface that states a distance is accepted. Two starts are proved for the torus and the sphere only, where no
  third minimum can be. Surfaces without a distance: see sphere_tracing_lipschitz.
- The paper's rays begin at the box, where its tables are run here, ours at their point nearest the domain's centre (the
  axis `origins`). It matters least here: distances do not cancel. Of 24,576 rays of Table 1's views (opencl:pocl,
  float32) the printed settings get the same 10 grazing ones wrong from the nearest point, the box and the eye.
- No claim that grazing roots are never missed: in float32 a distance that falls by less than its rounding is seen to
  grow, and within 1e-5 of tangency 38 of 384 rays of the family `grazing` end there (none in float64).

**Speed** opencl:intel, float32, torus at 1024 x 1024, 30°/35°, processor time. Table 1's factor of 3.7 between two
starts and one is not met: 0.9 at both thresholds. A second start saves the way out of a near tangency but not the way
into it: evaluations fall from 5.5 to 5.1 for each ray, from 7.9 to 7.0 for the slowest of 16 neighbours, which decides
here, from 24 to 18 for the slowest of 32 x 32 pixels, from 344 to 250 for the slowest of all. So no bookkeeping however
cheap brings a factor of 2 on 16 lanes. Kept: a loop that ends in one place, the march from inside in a loop of its own
(1.09 to 1.14 times faster than one loop with its state, one start and two alike). Rejected: one loop for all (0.95).
The printed second march (AHEAD = 0) takes 3.3 evaluations a ray at Table 1's 0° and ours 2.8, 2.7 and 2.5 at 54°; it
takes 0.96 to 1.02 times our time on opencl:pocl, 1.1 to 1.2 times on opencl:intel, with the same hits.
"""

from harness.contract import Method, Parameter, Surface


def accepts(surface: Surface) -> str | None:
    return None if surface.distance else "the surface states no distance; sphere_tracing_lipschitz needs none"


METHOD = Method(
    name="sphere_tracing",
    source="toledo2007",
    needs=("surface_distance",),
    parameters=(
        Parameter(
            "EPSILON",
            0.00003,
            "distance that counts as a hit, over the surface's feature radius",
            finer="down",
            sweep=(0.01, 0.001, 0.000003),
            per="FEATURE_RADIUS",
            printed=0.001,
        ),
        Parameter("RAYS", 2, "starts on a ray: 1 where it enters the domain, 2 also the point nearest its centre"),
        Parameter("AHEAD", 1, "1: the second march never goes back and ends at its minimum; 0: as printed", printed=0),
        Parameter("MAX_EVALUATIONS", 2000, "evaluations of the distance spent on one ray"),
    ),
    claims=frozenset({"conservative_bound", "finds_touch"}),
    settings={
        "Sphere Tracing": {"EPSILON": 0.001, "RAYS": 1, "AHEAD": 0},
        "2-rays S. Tracing": {"EPSILON": 0.001, "RAYS": 2, "AHEAD": 0},
    },
    accepts=accepts,
)
