// Intervals of operations that jump: floor, comparisons and selections. They are not part of `interval`, so that
// programs that do not need them stay as they are.

// Rounding makes no error here. The whole line stays the whole line.
Interval interval_floor(Interval a) {
    return make_interval(floor(a.lo), floor(a.hi));
}

Interval interval_sign(Interval a) {
    return make_interval(a.lo >= 0.0 ? real(1) : real(-1), a.hi >= 0.0 ? real(1) : real(-1));
}

// Returns 1 if a <= b everywhere, 0 if nowhere, and [0, 1] otherwise.
Interval interval_below(Interval a, Interval b) {
    return make_interval(a.hi <= b.lo ? real(1) : real(0), a.lo > b.hi ? real(0) : real(1));
}

// Returns p where the condition c is 1 everywhere, q where it is 0 everywhere, and otherwise what holds both. c is wider
// than that by the rounding of 1 - c, hence the half. The part that is not taken may be anything.
Interval interval_select(Interval c, Interval p, Interval q) {
    if (c.lo > 0.5) return p;
    if (c.hi < 0.5) return q;
    return make_interval(min(p.lo, q.lo), max(p.hi, q.hi));
}
