// Finds the first roots of f along the rays of a camera's pixels, by tiles: squares of pixels whose rays are isolated
// together. Along node rays, 4 by 4 in a tile, f is fitted in Bernstein form; the coefficients are interpolated by
// bicubic polynomials in Bernstein form, whose 16 control values are in the tile's lanes. A sign that all lanes have for
// certain is that of every ray of the tile. Here stands what several stages share; isolate.glsl, finish.glsl and
// packets.glsl are the stages.
#define N SURFACE_DEGREE
#define SHELLS 16  // sizes of the tables VALUE_ERRORS and GROWTH
#define DEPTHS 6
#define WIDER 0.03125          // pixels by which the nodes' square is larger on each side than the pixels' middles
#define THIRD 0.3333333432674407958984375

#define FINEST 4.0             // least tolerance of the refinement, in unit roundoffs
#define LAST_STEPS 2           // most steps by means of f
#define STRAIGHT 128.0         // longest step, in unit roundoffs, over which f may be a line as far as roundings tell
#define SHORT 0.0625           // longest last step but one, over the root of the tolerance

// What is known behind a single tile's first piece, for rays whose root lies before the domain.
#define UNKNOWN 0
#define IN_SECOND 1  // their next root is in the second piece
#define NOTHING 2

#define SEARCHING 0
#define EMPTY 1
#define SINGLE 2
#define OPEN 3

// Bounds of a fit's errors: `off` grows with a piece's depth, `noise` does not, `unit` is one halving's per degree.
STRUCT(Errors) struct Errors { real off; real noise; real unit; };

real error_at(Errors errors, int depth) {
    return GROWTH[min(depth, DEPTHS)] * errors.off + errors.noise + real(N * (depth + 1)) * errors.unit;
}

real rounding_of_samples(real away) {
    int shell = int(away * (real(SHELLS) / (REACH * DOMAIN_RADIUS)));
    return TRUST * UNIT_ROUNDOFF * TILE_ERRORS[min(shell, SHELLS - 1)];
}

// Returns each lane's square of the larger distance of two points from the domain's centre.
wide squared_distance(WideVec3 a, WideVec3 b) {
    vec3 center = DOMAIN_CENTER;
    WideVec3 p;
    WideVec3 q;
    p.x = a.x - center.x;
    p.y = a.y - center.y;
    p.z = a.z - center.z;
    q.x = b.x - center.x;
    q.y = b.y - center.y;
    q.z = b.z - center.z;
    return max(wide_inner(p, p), wide_inner(q, q));
}

// Newton's method for the roots of each lane's polynomial, whose first coefficient and last differ in sign; it starts
// from the cubic of make_bracket. Returns roots and slopes.
STRUCT(WideRoot) struct WideRoot { wide x; wide slope; };

#define FIND_ROOT(found, q, looking) { \
    wide a_ = wide(0.0); \
    wide b_ = wide(1.0); \
    wide step_ = wide(1.0); \
    found.x = CHOOSE(looking, 0.5 + THIRD * ((FIRST(q) + LAST(q)) / (FIRST(q) - LAST(q))), wide(0.5)); \
    found.slope = wide(-1.0); \
    BINOMIAL(q) \
    for (int i_ = 0; i_ < 8 && any_lane(BOTH(looking, MORE(fabs(step_), wide(0.0009765625)))); i_++) { \
        wide x_ = found.x; \
        wide value_; \
        wide rise_; \
        EVALUATE(q, x_, value_, rise_) \
        yes below_ = LESS(value_, wide(0.0)); \
        b_ = CHOOSE(below_, x_, b_); \
        a_ = CHOOSE(below_, a_, x_); \
        wide next_ = x_ - value_ / rise_; \
        next_ = CHOOSE(BOTH(NOT(LESS(next_, a_)), NOT(MORE(next_, b_))), next_, 0.5 * (a_ + b_)); \
        step_ = next_ - x_; \
        found.x = next_; \
        found.slope = rise_; \
    } \
}

// The rays of the pixels of a block: o + t d, with d of length 1, begins nearest to the domain's centre. A depth s is
// reached at t = base + (s - frame.middle) length.
STRUCT(Pencil) struct Pencil { WideVec3 o; WideVec3 d; wide shift; wide base; wide length; };

Pencil pencil_of(Work work, Frame frame, int i0, int j0) {
    Pencil rays;
    WideVec3 origin;
    WideVec3 d;
    origin.x = wide(frame.eye.x);
    origin.y = wide(frame.eye.y);
    origin.z = wide(frame.eye.z);
    real size = real(work.size);
    real share = 1.0 / size;
    wide x = (2.0 * lane_row(LANE_X, 0) + (real(2 * i0 + 1) - size)) * share;
    wide y = ((size - real(2 * j0 + 1)) - 2.0 * lane_row(LANE_Y, 0)) * share;
    d.x = (frame.forward.x + x * frame.right.x) + y * frame.up.x;
    d.y = (frame.forward.y + x * frame.right.y) + y * frame.up.y;
    d.z = (frame.forward.z + x * frame.right.z) + y * frame.up.z;
    rays.length = sqrt(wide_inner(d, d));  // where d is at depth 1
    wide inverse = 1.0 / rays.length;
    d.x = d.x * inverse;
    d.y = d.y * inverse;
    d.z = d.z * inverse;
    if (LISTED == 1) {
        WideRay ray;
        ray.origin = origin;
        ray.direction = d;
        ray = with_listed(work, i0, j0, ray);
        origin = ray.origin;
        d = ray.direction;
        rays.length = 1.0 / (d.x * frame.normal.x + d.y * frame.normal.y + d.z * frame.normal.z);
    }
    vec3 center = DOMAIN_CENTER;
    rays.d = d;
    rays.shift = (center.x - origin.x) * d.x + (center.y - origin.y) * d.y + (center.z - origin.z) * d.z;
    rays.o.x = wide_advanced(origin.x, rays.shift, d.x);
    rays.o.y = wide_advanced(origin.y, rays.shift, d.y);
    rays.o.z = wide_advanced(origin.z, rays.shift, d.z);
    rays.base = (frame.normal.x * (frame.origin.x - rays.o.x) + frame.normal.y * (frame.origin.y - rays.o.y)
                 + frame.normal.z * (frame.origin.z - rays.o.z)) * rays.length;
    return rays;
}

// f around points t: its mean over FIRST_PAIRS pairs of points, the last of them `reach` away; how far f is there from a
// line with the inverse slope g, in units of t; and whether the last pair shows that the root is between its points.
STRUCT(Around) struct Around { wide mean; wide bends; yes before; yes behind; };

Around around(Pencil rays, wide t, wide g, real reach) {
    Around near;
    wide inner = wide(0.0);
    near.bends = wide(0.0);
    for (int k = 1; k < FIRST_PAIRS; k++) {
        real away = FIRST_APART * real(k) * (UNIT_ROUNDOFF * 2.0 * DOMAIN_RADIUS);
        wide before = wide_value(wide_point(rays.o, t - away, rays.d));
        wide after = wide_value(wide_point(rays.o, t + away, rays.d));
        near.bends += fabs(g * (after - before) - 2.0 * away);
        inner += before + after;
    }
    wide first = wide_value(wide_point(rays.o, t - reach, rays.d));
    wide last = wide_value(wide_point(rays.o, t + reach, rays.d));
    near.bends += fabs(g * (last - first) - 2.0 * reach);
    real pairs = real(FIRST_PAIRS - 1);
    near.bends += fabs(g * (inner - pairs * (first + last))) * (0.5 / max(pairs, 1.0));
    near.mean = (inner + (first + last)) * (0.5 / (pairs + 1.0));
    near.before = NOT(MORE(first * g, wide(0.0)));
    near.behind = MORE(last * g, wide(0.0));
    return near;
}

// Newton's method on f itself within [a, b], from t on. `g` is the inverse of f's slope; it becomes that of the secant
// where a step is so long that rounding errors do not matter. `good`: the last step is short, and f changes its sign
// between two points at which it was evaluated.
STRUCT(Refined) struct Refined { wide t; yes good; int evaluations; };

Refined refined(Work work, Pencil rays, wide from, wide a, wide b, wide g, yes looking) {
    real share = max(TOLERANCE, FINEST * UNIT_ROUNDOFF);
    real tolerance = share * (2.0 * DOMAIN_RADIUS);
    real longest = min(STEP, SHORT * sqrt(share)) * (2.0 * DOMAIN_RADIUS);
    real clear = 32.0 * UNIT_ROUNDOFF * (2.0 * DOMAIN_RADIUS);  // a step in which rounding errors do not matter
    wide lo = a;
    wide hi = b;
    wide t = clamp(from, a, b);
    real rough = UNCERTAIN * UNIT_ROUNDOFF * (2.0 * DOMAIN_RADIUS);
    wide f = wide(0.0);
    yes seen_before = NOWHERE;
    yes seen_behind = NOWHERE;
    int evaluations = 1;
    if (FIRST_PAIRS > 0 && longest <= STRAIGHT * UNIT_ROUNDOFF * (2.0 * DOMAIN_RADIUS)) {
        real reach = 1.125 * longest;
        Around near = around(rays, t, g, reach);
        evaluations = 2 * FIRST_PAIRS;
        f = near.mean;
        seen_before = near.before;
        seen_behind = near.behind;
        // where f is a line over the only step, as far as roundings tell, another value of f would tell nothing more
        wide only = -f * g;
        real leftover = 2.0 * reach * (2.0 * UNIT_ROUNDOFF * 2.0 * DOMAIN_RADIUS);
        yes line = BOTH(AT_MOST(fabs(only), wide(longest)), AT_MOST(near.bends, wide(rough)));
        line = BOTH(BOTH(line, AT_MOST(fabs(only) * near.bends, wide(leftover))), BOTH(seen_before, seen_behind));
        if (!any_lane(BOTH(looking, NOT(line)))) {
            Refined straight;
            straight.t = clamp(t + only, a, b);
            straight.good = line;
            straight.evaluations = evaluations;
            return straight;
        }
    } else {
        f = wide_value(wide_point(rays.o, t, rays.d));
    }
    yes behind = MORE(f * g, wide(0.0));  // the root is before t
    seen_before = EITHER(seen_before, NOT(behind));
    seen_behind = EITHER(seen_behind, behind);
    hi = CHOOSE(behind, t, hi);
    lo = CHOOSE(behind, lo, t);
    wide next = t - f * g;
    next = CHOOSE(BOTH(NOT(LESS(next, lo)), NOT(MORE(next, hi))), next, 0.5 * (lo + hi));
    wide step = next - t;
    for (int k = 0; k < STEPS && any_lane(BOTH(looking, MORE(fabs(step), wide(longest)))); k++) {
        wide f1 = wide_value(wide_point(rays.o, next, rays.d));
        evaluations += 1;
        wide secant = step / (f1 - f);
        g = CHOOSE(BOTH(MORE(fabs(step), wide(clear)), MORE(secant * g, wide(0.0))), secant, g);
        t = next;
        f = f1;
        behind = MORE(f * g, wide(0.0));
        seen_before = EITHER(seen_before, NOT(behind));
        seen_behind = EITHER(seen_behind, behind);
        hi = CHOOSE(behind, t, hi);
        lo = CHOOSE(behind, lo, t);
        next = t - f * g;
        next = CHOOSE(BOTH(NOT(LESS(next, lo)), NOT(MORE(next, hi))), next, 0.5 * (lo + hi));
        step = next - t;
    }
    // one last step with the mean of f over points around t, in which rounding errors cancel: over more of them where f
    // between the first ones is far from a line; a second one where the first leaves too much by its own estimate: it
    // leaves that share of itself which is left of f
    yes short_step = AT_MOST(fabs(step), wide(longest));
    yes enough = short_step;
    yes sloped = NOT(NOWHERE);  // steps by g are not far too short for the slope that f's values have
    for (int turn = 0; turn < LAST_STEPS && FIRST_PAIRS > 0; turn++) {
        if (turn > 0 && !any_lane(BOTH(looking, NOT(enough)))) break;
        wide sum = wide(0.0);
        wide bends = wide(0.0);
        wide rise = wide(0.0);
        real apart = 0.0;
        int pairs = 0;
        for (int k = 1; k <= max(FIRST_PAIRS, PAIRS); k++) {
            if (k == FIRST_PAIRS + 1 && !any_lane(BOTH(looking, MORE(bends, wide(rough))))) break;
            pairs = k;
            real place = k <= FIRST_PAIRS ? FIRST_APART * real(k) : APART * real(k - FIRST_PAIRS);
            real away = place * (UNIT_ROUNDOFF * 2.0 * DOMAIN_RADIUS);
            wide before = wide_value(wide_point(rays.o, next - away, rays.d));
            wide after = wide_value(wide_point(rays.o, next + away, rays.d));
            sum += before + after;
            bends += fabs(g * (after - before) - 2.0 * away);
            rise += after - before;
            apart += 2.0 * away;
            seen_before = EITHER(seen_before, NOT(MORE(before * g, wide(0.0))));
            seen_behind = EITHER(seen_behind, MORE(after * g, wide(0.0)));
        }
        evaluations += 2 * pairs;
        sloped = MORE(rise * g, wide(0.0625 * apart));
        wide mean = sum * (1.0 / real(2 * pairs));
        // f was 0 at this place by the step before: after a short one, that is one point more
        yes known = AT_MOST(fabs(step), wide(0.25 * clear));
        wide weight = CHOOSE(known, wide(real(2 * pairs) / real(2 * pairs + 1)), wide(1.0));
        if (any_lane(MORE(fabs(step), wide(clear)))) {
            wide secant = step / (mean - f);
            g = CHOOSE(BOTH(MORE(fabs(step), wide(clear)), MORE(secant * g, wide(0.0))), secant, g);
        }
        step = -mean * g * weight;
        next = next + step;
        enough = AT_MOST(fabs(step) * min(fabs(mean), fabs(f)), tolerance * max(fabs(f), wide(REAL_TINY)));
        enough = EITHER(enough, AT_MOST(fabs(step), wide(0.25 * clear)));  // a step among rounding errors
        f = mean;
    }
    yes seen = BOTH(seen_before, seen_behind);
    if (any_lane(BOTH(looking, NOT(seen)))) {
        wide other = wide_value(wide_point(rays.o, CHOOSE(seen_before, b, a), rays.d));
        evaluations += 1;
        behind = MORE(other * g, wide(0.0));
        seen = EITHER(seen, CHOOSE(seen_before, behind, NOT(behind)));
    }
    Refined result;
    // the signs of single values, which made [lo, hi], are less certain than the mean
    result.t = clamp(next, max(lo - longest, a), min(hi + longest, b));
    result.good = BOTH(BOTH(seen, sloped), BOTH(short_step, enough));
    result.evaluations = evaluations;
    return result;
}
