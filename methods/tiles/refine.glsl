// Refines the roots of a single tile's pixels, or of a packet's.
#define STRAIGHT 128.0  // longest step, in units, over which f may be a line as far as roundings tell
#define SHORT 0.0625    // longest last step but one, over the root of the tolerance
#define CLEAR 32.0      // a step in which rounding errors do not matter, in units

// f around points t: its mean over FIRST_PAIRS pairs of points, the last of them `reach` away; how far f is there from a
// line with the inverse slope g, in units of t; and whether the last pair shows that the root is between its points.
STRUCT(Around) struct Around { wide mean; wide bends; yes before; yes behind; };

Around around(Pencil rays, wide t, wide g, real reach) {
    Around near;
    wide inner = wide(0.0);
    near.bends = wide(0.0);
    for (int k = 1; k < FIRST_PAIRS; k++) {
        real away = FIRST_APART * real(k) * UNIT;
        wide before = wide_value(wide_point(rays.o, t - away, rays.d));
        wide after = wide_value(wide_point(rays.o, t + away, rays.d));
        near.bends += fabs(g * (after - before) - 2.0 * away);
        inner += before + after;
    }
    wide first = wide_value(wide_point(rays.o, t - reach, rays.d));
    wide last = wide_value(wide_point(rays.o, t + reach, rays.d));
    near.bends += fabs(g * (last - first) - 2.0 * reach);
    real pairs = real(max(FIRST_PAIRS - 1, 0));
    near.bends += fabs(g * (inner - pairs * (first + last))) * (0.5 / max(pairs, real(1)));
    near.mean = (inner + (first + last)) * (0.5 / (pairs + 1.0));
    near.before = NOT(MORE(first * g, wide(0.0)));
    near.behind = MORE(last * g, wide(0.0));
    return near;
}

// A root within [a, b]. `good`: the last step leaves little, and f changes its sign between two points at which it was
// evaluated.
STRUCT(Refined) struct Refined { wide t; yes good; int evaluations; };

// Refines the root `from`. `slope` is the inverse of f's slope; it becomes that of the secant where a Newton step is so
// long that rounding errors do not matter.
Refined refined(Pencil rays, wide from, wide a, wide b, wide slope, yes looking) {
    real share = max(TOLERANCE, FINEST * UNIT_ROUNDOFF);
    real tolerance = share * (2.0 * DOMAIN_RADIUS);
    real longest = min(STEP, SHORT * sqrt(share)) * (2.0 * DOMAIN_RADIUS);
    real reach = 1.125 * longest;
    real rough = max(UNCERTAIN * UNIT, 0.5 * tolerance);
    bool near_enough = longest <= STRAIGHT * UNIT;
    wide g = slope;
    wide step = wide(REAL_INFINITY);
    wide lo = a;
    wide hi = b;
    yes seen_before = NOWHERE;
    yes seen_behind = NOWHERE;
    Around near;
    Refined result;
    result.t = clamp(from, a, b);
    result.evaluations = 0;
    for (int turn = 0; turn < 2; turn++) {
        // Newton's method on f itself
        wide f = wide(0.0);
        for (int k = 0; k <= STEPS && !near_enough && any_lane(BOTH(looking, MORE(fabs(step), wide(longest)))); k++) {
            wide f1 = wide_value(wide_point(rays.o, result.t, rays.d));
            result.evaluations += 1;
            wide secant = step / (f1 - f);
            yes clear = BOTH(MORE(fabs(step), wide(CLEAR * UNIT)), MORE(secant * g, wide(0.0)));
            if (k > 0) g = CHOOSE(clear, secant, g);
            f = f1;
            yes beyond = MORE(f * g, wide(0.0));  // the root is before t
            seen_before = EITHER(seen_before, NOT(beyond));
            seen_behind = EITHER(seen_behind, beyond);
            hi = CHOOSE(beyond, result.t, hi);
            lo = CHOOSE(beyond, lo, result.t);
            wide next = result.t - f * g;
            next = CHOOSE(BOTH(NOT(LESS(next, lo)), NOT(MORE(next, hi))), next, 0.5 * (lo + hi));
            step = next - result.t;
            result.t = next;
        }
        // the mean of f over points around t, in which rounding errors cancel
        near = around(rays, result.t, g, reach);
        result.evaluations += 2 * max(FIRST_PAIRS, 1);
        seen_before = EITHER(seen_before, near.before);
        seen_behind = EITHER(seen_behind, near.behind);
        step = -near.mean * g;
        result.t = clamp(result.t + step, a, b);
        // where f is a line over the step, as far as roundings tell, another value of f would tell nothing more
        yes line = BOTH(AT_MOST(fabs(step), wide(longest)), AT_MOST(near.bends, wide(rough)));
        line = BOTH(line, AT_MOST(fabs(step) * near.bends, wide(tolerance * reach)));
        result.good = BOTH(line, BOTH(seen_before, seen_behind));
        yes left = BOTH(looking, NOT(result.good));
        if (!any_lane(left)) return result;
        bool far = any_lane(BOTH(left, MORE(fabs(step), wide(longest))));
        if (!far && any_lane(BOTH(left, MORE(near.bends, wide(rough))))) break;
        near_enough = false;
    }
    // elsewhere rounding errors are kept out of f
    wide sign = CHOOSE(MORE(g, wide(0.0)), wide(1.0), wide(-1.0));
    wide wrong = near.bends * (0.5 / reach);
    Corrected exact = corrected(rays.eye, rays.shift, rays.d, result.t, a, b, sign, g, wrong, looking);
    result.evaluations += exact.evaluations;
    result.t = CHOOSE(exact.good, exact.t, result.t);
    yes seen = BOTH(EITHER(seen_before, exact.before), EITHER(seen_behind, exact.behind));
    if (any_lane(BOTH(looking, NOT(seen)))) {
        wide other = wide_value(wide_point(rays.o, CHOOSE(seen_before, b, a), rays.d));
        result.evaluations += 1;
        yes beyond = MORE(other * g, wide(0.0));
        seen = EITHER(seen, CHOOSE(seen_before, beyond, NOT(beyond)));
    }
    result.good = BOTH(EITHER(result.good, exact.good), seen);
    return result;
}
