"""Sphere tracing by the surface's own distance, with one start or two.

The kernel marches along the ray by the distance to the surface until that distance is below EPSILON. With RAYS = 2 the
march goes on from a second start, the ray's point nearest the torus's centre, as soon as the distance has grown.

**Source** toledo2007, section 4.3 (Sphere Tracing and 2-rays S. Tracing of Table 1), after Hart 1996.

**Theory** No point of the surface is nearer than the distance, so a step of that length passes no root. Near a tangency
the distances are small over a long part of the ray, and so are the steps. On the torus a second start helps. Along a
line the distance to the core circle takes every value at most four times (equation 2 has four roots for every r), so it
has at most two minima. When the distance grows, the first minimum is passed, and the march goes on from t_M = -(o·v)
towards the other one. When it grows there after it fell, both minima are passed, and there is no root.

**Changes against the paper**
- AHEAD = 1 (default), two starts: a first march that has already passed t_M goes on where it is. The second march ends
  when its distance grows after it fell, since no third minimum exists. AHEAD = 0 is as printed: the second march starts
  at t_M whatever was passed, and ends where the first march ends, at the domain's exit, or as exhausted after
  MAX_EVALUATIONS. A second start inside the torus turns back to the root behind it, as the signed distance does.
- A start inside the surface marches by the absolute value of the distance, and has no second start.
- Any surface with a distance is accepted: one that is stated, which is tested against certified hits, or f itself
  where it is proved that f is nowhere greater than the distance (surfaces.proofs.lipschitz). A distance need not be
  exact: a bound takes more steps. For surfaces without one see sphere_tracing_lipschitz.
- Two starts are proved for the torus about the z axis and the sphere about the origin only, on which no third minimum
  can exist; t_M is nearest to the origin, wherever the domain is. Every other distance is marched from one start.
- Rays begin at their point nearest the domain's centre (`origins` of a config). The paper's rays begin at the box, and
  configs for its tables do the same. This matters less here than for other methods, since distances do not cancel: of
  24,576 rays of Table 1's views (opencl:pocl, float32) the printed settings get the same 10 grazing ones wrong from the
  nearest point, the box and the eye.
- It is not claimed that grazing roots are never missed. In float32 a distance that falls by less than its rounding
  error seems to grow. Within 1e-5 of tangency this loses 38 of 384 rays of the family `grazing` (none in float64).

**Evaluations counted** Evaluations of the distance.

**Speed** Table 1's factor of 3.7 between two starts and one does not come out: it is 0.9 at both thresholds.
opencl:intel, float32, torus at 1024x1024, azimuth 30° and elevation 35°, processor time. A second start saves the way
out of a near tangency, but not the way into it. On 16 lanes the slowest of 16 neighbours decides, so no saving in
bookkeeping can bring a factor of 2.

    evaluations                           one start  two starts
    ------------------------------------  ---------  ----------
    of a ray, mean                        5.5        5.1
    of the slowest of 16 neighbours       7.9        7.0
    of the slowest of 32 by 32 pixels     24         18
    of the slowest of all                 344        250

**What was tried** Processor time on opencl:intel, float32, torus at 1024x1024, azimuth 30° and elevation 35°; in the
last two rows Table 1's views.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    a loop that ends in one place, and a loop of its own    1.09 to 1.14 times faster than one loop with its    yes
      for the march from inside                             state, for one start and two alike
    one loop for all                                        0.95                                                no
    AHEAD = 1, over AHEAD = 0: evaluations a ray            2.8 against 3.3 at 0°; 2.5 against 2.7 at 54°       yes
    AHEAD = 0, over AHEAD = 1: time, with the same hits     0.96 to 1.02 on opencl:pocl, 1.1 to 1.2 on          no
                                                            opencl:intel
"""

from collections.abc import Mapping, Sequence

from harness.contract import Method, Parameter, Precision, Surface

TWO_MINIMA = ("sphere", "torus")  # surfaces of the catalog; along a line no distance to them has a third minimum
LONGEST = 20  # operations of their distances


def accepts(surface: Surface) -> str | None:
    """Say why the surface is refused; None if it has a distance."""
    return None if surface.distance else "the surface states no distance; sphere_tracing_lipschitz needs none"


def two_minima(surface: Surface) -> bool:
    """Return whether the distance is written as that of a torus about the z axis or of a sphere about the origin."""
    import surfaces
    from surfaces.formula import parse

    def outline(of: Surface) -> str:
        """Write the distance without the numbers of its constants; "" where it is longer than any of these."""
        tape = parse(of.distance or "0", dict(of.parameters))
        if len(tape.ops) > LONGEST:
            return ""
        texts: list[str] = []
        for op in tape.ops:
            own = str(op.args) if op.name == "var" else ", ".join(texts[i] for i in op.inputs)
            texts.append(f"{op.name}({own})")
        return texts[tape.outputs[0]]

    return outline(surface) in {outline(surfaces.get(name)) for name in TWO_MINIMA}


def tables(surface: Surface, _: Mapping[str, float | int], __: Precision) -> Mapping[str, Sequence[float]]:
    """Return STARTS: on how many starts a march may rely."""
    return {"STARTS": [2.0 if two_minima(surface) else 1.0]}


METHOD = Method(
    name="sphere_tracing",
    source="toledo2007",
    needs=("surface_distance",),
    parameters=(
        Parameter(
            "EPSILON",
            0.00003,
            "distance from the surface that counts as a hit, over the surface's feature radius",
            finer="down",
            sweep=(0.01, 0.001, 0.000003),
            per="FEATURE_RADIUS",
            printed=0.001,
        ),
        Parameter(
            "RAYS",
            2,
            "starts on a ray; 1: where it enters the domain; 2: also at its point nearest a torus's or sphere's centre",
        ),
        Parameter(
            "AHEAD",
            1,
            "second march; 1: never goes back, and ends behind its minimum; 0: starts at t_M and ends as "
            "the first does",
            printed=0,
        ),
        Parameter("MAX_EVALUATIONS", 2000, "evaluations of the distance on one ray, after which the ray is exhausted"),
    ),
    claims=frozenset({"conservative_bound", "finds_touch"}),
    settings={
        "Sphere Tracing": {"EPSILON": 0.001, "RAYS": 1, "AHEAD": 0},
        "2-rays S. Tracing": {"EPSILON": 0.001, "RAYS": 2, "AHEAD": 0},
    },
    accepts=accepts,
    tables=tables,
)
