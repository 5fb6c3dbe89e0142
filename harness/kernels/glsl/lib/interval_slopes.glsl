// Derivatives over boxes, for surface_gradient_range. Where f has a kink, such a derivative holds those of both sides.
// Where f may jump, or a derivative may be too large, no derivative is known: `known` says so.
STRUCT(GradientRange) struct GradientRange { Interval value; Interval x; Interval y; Interval z; bool known; };

#define LEAST_DIVISOR 9.5367431640625e-7  // 2^-20: what derivatives of roots, logarithms and angles divide by at least

// Returns the least interval that holds both.
Interval interval_hull(Interval a, Interval b) {
    return make_interval(min(a.lo, b.lo), max(a.hi, b.hi));
}

// Returns -1 where a <= b everywhere, 1 where a >= b everywhere, and 0 otherwise.
int order_of(Interval a, Interval b) {
    if (a.hi <= b.lo) return -1;
    return a.lo >= b.hi ? 1 : 0;
}

// Returns the derivative of min(a, b), where p is that of a, q is that of b, and `order` is order_of(a, b).
Interval slope_of_lesser(int order, Interval p, Interval q) {
    if (order < 0) return p;
    if (order > 0) return q;
    return interval_hull(p, q);
}

// Returns the derivative of |a|, where p is that of a.
Interval slope_of_abs(Interval a, Interval p) {
    if (a.lo >= 0.0) return p;
    if (a.hi <= 0.0) return interval_neg(p);
    return interval_hull(p, interval_neg(p));
}

// Returns the derivative of a selection, where p and q are those of its parts.
Interval slope_of_select(Interval c, Interval p, Interval q) {
    if (c.lo > 0.5) return p;
    if (c.hi < 0.5) return q;
    return interval_hull(p, q);
}

// Returns the derivative of a length, a root of a sum of squares, by one of the numbers that are squared: their quotient,
// which is never outside [-1, 1].
Interval share_of_length(Interval part, Interval whole) {
    Interval share = interval_div(part, whole);
    return make_interval(part.lo >= 0.0 ? max(share.lo, real(0)) : max(share.lo, real(-1)),
                         part.hi <= 0.0 ? min(share.hi, real(0)) : min(share.hi, real(1)));
}

// Returns whether derivatives that divide by a are known.
bool divides(Interval a) {
    return a.lo > LEAST_DIVISOR;
}

// Returns a / b, and 0 where derivatives that divide by b are not known.
Interval known_quotient(Interval a, Interval b) {
    if (divides(b)) return interval_div(a, b);
    return make_interval(0.0, 0.0);
}

// Returns whether a power has a value all over a: rounding may take what is 0 a little below it.
bool has_powers(Interval a) {
    return a.lo >= -16.0 * REAL_TINY;
}

// Returns whether points (x, y), x in b and y in a, keep away from the cut of angles, y = 0 and x <= 0.
bool off_the_cut(Interval a, Interval b) {
    return a.lo > 0.0 || a.hi < 0.0 || b.lo > 0.0;
}
