"""First-root isolation in Bernstein form, which trusts a sign only where it exceeds a bound of the rounding errors.

The kernel fits f along the ray by a polynomial in Bernstein form, and halves the ray's interval in the domain from the
near end on. It drops pieces whose coefficients prove that they hold no root. In the first piece with exactly one root,
Newton's method with f's own values finds that root.

**Source** firsthit's own. It is made of these parts: the fit of szente, section 2.1; Descartes' rule of signs in the
Bernstein basis and de Casteljau's algorithm (Lane, Riesenfeld 1981); running error analysis (Higham 2002, section 3.3);
one integer that holds the path of a halving, in place of a stack, as in beamcasting, section III.E.

**Theory** Along the ray f is a polynomial. On a piece of the ray the number of its roots is at most the number of sign
changes in the piece's Bernstein coefficients, and differs from it by an even number. So a piece without a change has no
root, and a piece with one change has exactly one. The fit on the ray's interval is halved from the near end, depth
first. No stack is needed, since one integer holds the path to a piece. Pieces without a change are dropped. The first
piece with one change holds the first root, once f itself confirms the sign at its far end. If the coefficients of a fit
change sign as often as its samples do, each root lies between two samples, and nothing is halved (COUNTED).

The sign of a coefficient counts only if its magnitude exceeds an error bound. The bound is the share TRUST of the worst
case of the sum of three errors:
- f's rounding errors in the samples (bounded by harness/kernels/rounding.py), times the factor GROWTH by which a
  piece's coefficients amplify them. With the length of the piece GROWTH falls from the norm of the fit's inverse matrix
  to Lebesgue's constant.
- The rounding errors of the fit, computed from its samples.
- The rounding errors of each halving.

A piece stays open as long as signs that decide about it are not certain. After TRUSTED halvings, a piece that is open
or has several changes of sign is sampled and fitted anew. The errors are then those of the piece's own surroundings,
not those of the far ends of the ray, where f is a thousand times larger. In three cases the signs of f decide instead,
at the samples and where the fit has its minimum: where all coefficients of a new fit are below NOISE error bounds,
where the piece is the shortest allowed, and after FITS fits.

Newton's steps end when the error that the last one leaves is at most TOLERANCE, and not when that step is short: next
to a double root each step is only half of the way that is left. A step s leaves about f''/(2 f') s², and up to four
times that next to a double root, where f'' is the change of the slope over the step before. Four times is what is
compared. A step that had to be replaced by halving the bracket counts with its whole length. Since the estimate says
nothing where f'' passes through 0, the last step is also at most 1/16 of the square root of TOLERANCE. All lengths are
over the ray's length in the domain. The tolerance is never less than 4 unit roundoffs, so that the default is what the
precision can tell.

The error of a refined root is mostly the error of the computed values of f near it, divided by f's slope. That error
changes from each floating-point number t to the next like noise, so a mean over several points reduces it. The last
Newton step therefore uses the mean of f over PAIRS pairs of points on both sides of the root, a few unit roundoffs
apart. This reduces the median error to two thirds with 2 pairs (the default), and to half with 16 pairs.

**What is promised** A hit is a place where the computed value of f changes its sign. So false hits occur on drowned
rays only, on which |f| falls below the bound of its own rounding errors. The method does not require |f| to leave that
bound: on such rays as many hits are real as false, and the real ones would be lost.

The promise is about rays with two properties: any other answer is at least 2^-11 domain radii away (Truth.margin), and
the first root's condition number times the unit roundoff is at most 2^-8. On these rays no crossing is missed, no later
root is taken, and the error is below the tolerance plus what rounding must add. Tests check this on random rays over
the catalog, on a million where asked; ten million have been checked.

A touch is answered as a miss, since f does not change its sign there, or as a hit at the touch where rounding makes f
cross. Other roots can be lost only inside the error bound: pairs of roots between which |f| stays below it. The bound
is the largest over a shell about the domain's centre. Where f differs by powers of ten within a shell, it hides pairs
that float32 tells apart, and the promise is not kept: on the gallery's folded_dodecic (degree 12, in a box) 1 of 570
rays of configs/gallery.toml at 24x24 gets a later root. Its first two roots are 0.009 domain radii apart, |f| between
them reaches 0.085, and the shell's bound is 8.9. No other surface of the gallery has such a ray in that view.

On the families of hard rays (`firsthit run configs/stability.toml`: rays that become harder from rung to rung) it holds
16 of the 20 families that float32 can decide; lu_lipschitz holds 17. Clustered roots, two of the three families of
nodes, and thin tori break it. In float64 it holds all 20: it is right on all 14,727 rays that float64 can decide.

**Changes against the paper** There is no paper of the whole. Against the parts it is made of:
- When a piece without a root has been passed, the coefficients of what lies behind it are not restored from
  coefficients that de Casteljau's algorithm left, but fitted anew. Their errors are smaller, and a vector of rays needs
  less time.
- szente's products are compensated at every degree. Here they are from degree 17 on only (COMPENSATED).

**Evaluations counted** Evaluations of f.

**Speed** Time of a frame in ms: `firsthit run configs/front.toml`, float32, 1024x1024, on two cores. No ray is wrong.

    device           method      calyx  Barth sextic  Endraß octic  Barth decic  16-ball
    ---------------  ----------  -----  ------------  ------------  -----------  -------
    opencl:intel     bernstein   8.1    11.5          22.8          26.8         30.5
    opencl:intel     eft_yuksel  8.3    17.3          33.7          50.9         97.7
    opengl:llvmpipe  bernstein   40     33            48            59           116
    opengl:llvmpipe  eft_yuksel  93     144           253           447          960

How many times as fast as eft_yuksel in the mean of the five: 1.8 on opencl:intel and 5.6 on opengl:llvmpipe; with a
prepass of beams before bernstein alone 2.5 and 6.7; with beams before both 1.8 and 5.2. Behind beams the 99.9th
percentile of its error is no larger than eft_yuksel's on any of the five (on the octic 6.5e-6 of the radius against
7.3e-6). Without beams it is 7.9e-6 on the octic, and smaller than eft_yuksel's elsewhere.

On opencl:intel the rays that run together as lanes of one vector wait for the one among them that is fitted most often.
Sampling, fitting and the last steps take from a quarter (decic) to over a half (calyx) of the time. So if isolation
cost nothing, the factor over eft_yuksel would be 5.8 in the mean.

The method is on the front of speed and largest error (no other method is better in both) on all twelve surfaces of
degree 5 and more, on both devices and at both sizes. Of the surfaces of lower degree it is on the front of all but the
horn torus (analytic and newton are there) and, at 512x512, the spindle torus (newton is there).

**What was tried** Times over those of the default, float32, unless a row says otherwise. Above 1 is slower.

    what was tried                                          measured                                            kept
    ------------------------------------------------------  --------------------------------------------------  ----
    refinement by bracketed Newton steps with f's value     takes 5 evaluations                                 yes
      and the fit's slope (this row and those by Illinois'
      method and ITP: on all surfaces)
    Newton's steps until the last is 2^-18 of the ray       1.01 times the evaluations (the mean of 18          no
      long, in place of an estimate of the error that is    surfaces), and only 13 of 20 families of hard rays
      left (this and the next three rows: float32)          are held (float64: 13 of 20)
    the same until it is 2^-30 long                         16 families (float64: 20), 1.67 times the           no
                                                            evaluations: steps follow f's rounding errors
    the same until it is 8 unit roundoffs long              16 families, 1.03 times the evaluations             no
    the error that is left, from the ratio of the last two  15 families: a halving before the last step spoils  no
      steps                                                 the ratio
    refinement by Illinois' method                          ends too early where f has two scales: errors up    no
                                                            to 3e-4
    refinement by ITP                                       never ends too early; the slowest of 16 rays takes  no
                                                            18 evaluations
    the mean of f over pairs of points                      2 pairs cost 1 to 10 %, 16 pairs up to 20 %, since  yes
                                                            all rays of a vector take them together
    coefficients of the far half kept, and restored after   processor time at 512x512: 34 ms (16-ball), 21 ms   no
      the near half, in place of a new fit                  (decic) and 17 ms (octic), against
                                                            18, 17 and 15 ms with new fits. Intel's compiler
                                                            runs both sides of a branch on which rays differ,
                                                            so each step pays for a rare restoring
    new fits in place of halving, from the first crossing   0.1 to 0.8 times as fast: only halving brings       no
      of the control polygon on                             GROWTH down
    convex pieces decided by f at their minimum             0.6 to 0.9 times as fast: fewer fits, each dearer   no
    states in one variable, bits of coefficients in an      not vectorised, ten times slower                    no
      integer, one loop for everything
    compensated products below degree 12                    gain nothing: the samples' own errors undo them     no
    plain products from degree 12 to 16, over compensated   0.7 to 0.96 times the time on five surfaces, 1.35   yes
                                                            on the sixth; 0.7 on opengl:llvmpipe
    compensated products only where a piece is fitted anew  1.2 times the time on the 16-ball                   no
      (szente's future work)
    degree 20                                               seven times the time of degree 18 on opencl:intel,  -
                                                            whose compiler no longer unrolls the halving
    TRUST = 1/64                                            at single points f's own errors reach 1/25 to 1/12  yes
                                                            of their worst case; sums of them reach less
    TRUST = 1/8                                             the same answers in 1.05 to 1.8 times the time      no
    the fit's rounding errors counted double                counted once, 18 of two million rays of the decic   yes
                                                            took a later root
    halving beyond TRUSTED where nothing is open            fewer evaluations, and slower                       no
    NOISE = 4, over NOISE = 1                               0.9 times the time on the octic; 16 of two million  yes
                                                            of its rays no longer run out of fits
    f at the fit's minimum, beside the samples, where all   without it, close pairs of roots are lost at ten    yes
      is noise                                              times the distance (clustered roots, nodes, double
                                                            lines); up to 10 % slower
    f's sign at the far end of an open piece, in place of   loses pairs of roots by the hundred                 no
      a new fit
    the 16 rays of a vector from 4 by 4 pixels              0.87 to 0.97 times the time from degree 5 on, but   no
                                                            1.26 for newton on the torus
    an ideal prepass: each tile of 16 by 16 pixels is       1.1 to 1.9 times as fast. So affine arithmetic in   no
      given the exact depths of its hits at no cost         the beams (beamcasting's future work) could gain
                                                            no more, and was not tried
"""

from collections.abc import Mapping

from harness.contract import Method, Parameter, Precision, Surface
from harness.kernels.fitting import cannot_be_fitted


def _tables(surface: Surface, _knobs: Mapping[str, float | int], precision: Precision) -> dict[str, list[float]]:
    from harness.kernels.isolating import isolation_tables

    return isolation_tables(surface, precision)


METHOD = Method(
    name="bernstein",
    source="firsthit",
    needs=("surface_value",),
    libraries=("dual", "fit", "polynomial", "fit_samples"),
    parameters=(
        Parameter(
            "TOLERANCE",
            2.0**-51,
            "error that Newton's last step leaves by its own estimate, over the ray's length in the domain; never less "
            "than 4 unit roundoffs",
            finer="down",
            sweep=(2.0**-8, 2.0**-12, 2.0**-18),
            per="2.0 * DOMAIN_RADIUS",
        ),
        Parameter(
            "PAIRS",
            2,
            "pairs of samples around the root, over which the last Newton step takes the mean of f; 0: no such step",
            sweep=(0, 16),
        ),
        Parameter(
            "APART",
            4.0,
            "distance between neighbouring samples of PAIRS, in unit roundoffs of the ray's length in the domain",
        ),
        Parameter(
            "COUNTED",
            5,
            "highest degree at which sign changes of coefficients and of samples are compared, to save the halving",
        ),
        Parameter(
            "COMPENSATED",
            17,
            "lowest degree at which the fit uses compensated products and sums; below it uses plain ones",
        ),
        Parameter("TRUST", 0.015625, "share of the worst case of the rounding errors that counts as their bound"),
        Parameter("TRUSTED", 4, "halvings of a fitted piece before what is still open is fitted anew"),
        Parameter(
            "NOISE",
            4.0,
            "a fitted piece whose coefficients are below this many error bounds is decided by the signs of f's samples",
        ),
        Parameter("WIDENING", 8.0, "length of the next piece to be fitted, over the length of the piece just decided"),
        Parameter("FITS", 64, "fits on one ray after which the signs of f's samples decide what is open"),
        Parameter("MAX_EVALUATIONS", 4096, "evaluations of f on one ray, after which the ray is exhausted"),
    ),
    claims=frozenset({"no_false_hit"}),
    accepts=cannot_be_fitted,
    tables=_tables,
)
