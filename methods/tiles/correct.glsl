// Corrects roots by values of f in compensated arithmetic, whose rounding errors are about those of twice the precision.
#define UNIT (UNIT_ROUNDOFF * 2.0 * DOMAIN_RADIUS)
#define FINEST 4.0       // least tolerance, in unit roundoffs
#define MOST_VALUES 24   // of f, for one root
#define FARTHEST 4096.0  // that a root may be moved, in units
#define LEFT_OVER 0.125  // share of the tolerance that the last step may leave

// `good`: the last step leaves little by its own estimate. `before`, `behind`: f was seen to have the sign that it has
// before the root, and behind it.
STRUCT(Corrected) struct Corrected { wide t; yes good; yes before; yes behind; int evaluations; };

// Corrects the root `from` of f on the rays o + (shift + t) d, within [a, b]. `sign` is that of f behind the root. A step
// with the inverse slope g ends it, if that leaves little. Else the second point is SECANT units away on the root's side,
// and the next ones are secants' within the bracket that f's signs give. Where a secant leads out of it, the next point is
// twice as far away as before, or the middle of the bracket.
// A step leaves the share of itself by which its inverse slope is wrong: `wrong` is that of g, and a secant's is what it
// differs by from the one before.
Corrected corrected(WideVec3 o, wide shift, WideVec3 d, wide from, wide a, wide b, wide sign, wide g, wide wrong,
                    yes looking) {
    real allowed = LEFT_OVER * max(TOLERANCE, FINEST * UNIT_ROUNDOFF) * (2.0 * DOMAIN_RADIUS);
    real away = SECANT * UNIT;
    Corrected found;
    found.t = from;
    found.good = NOWHERE;
    found.before = NOWHERE;
    found.behind = NOWHERE;
    found.evaluations = 0;
    WidePairs origin = wide_far_point(o, shift, d);
    yes moving = looking;
    wide lo = max(from - FARTHEST * UNIT, a);
    wide hi = min(from + FARTHEST * UNIT, b);
    wide inverse = g;
    wide share = wrong;
    wide t = from;
    wide t_before = from;
    wide f_before = wide(0.0);
    for (int k = 0; k < MOST_VALUES && any_lane(moving); k++) {
        WidePair value = compensated_value(origin, t, d);
        wide f = value.hi + value.lo;
        found.evaluations += 1;
        yes beyond = MORE(f * sign, wide(0.0));  // the root is before t
        found.before = EITHER(found.before, NOT(beyond));
        found.behind = EITHER(found.behind, beyond);
        hi = CHOOSE(beyond, t, hi);
        lo = CHOOSE(beyond, lo, t);
        if (k > 0) {
            wide secant = (t - t_before) / (f - f_before);
            share = fabs(1.0 - inverse / secant);
            inverse = secant;
        }
        wide next = t - f * inverse;
        yes taken = BOTH(MORE(inverse * sign, wide(0.0)), BOTH(AT_MOST(lo, next), AT_MOST(next, hi)));
        yes last = BOTH(BOTH(moving, taken), AT_MOST(fabs(next - t) * min(share, wide(1.0)), wide(allowed)));
        if (k == 0) last = BOTH(last, AT_MOST(share, wide(0.5)));
        found.t = CHOOSE(last, next, found.t);
        found.good = EITHER(found.good, last);
        moving = BOTH(moving, NOT(last));
        yes bracketed = BOTH(found.before, found.behind);
        wide other = CHOOSE(bracketed, 0.5 * (lo + hi), CHOOSE(beyond, max(t - away, lo), min(t + away, hi)));
        if (k == 0) taken = NOWHERE;
        away = 2.0 * away;
        t_before = t;
        f_before = f;
        t = CHOOSE(taken, next, other);
    }
    return found;
}
