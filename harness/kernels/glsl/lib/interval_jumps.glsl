// Intervals of operations that jump: floor, comparisons and selections. They are not part of `interval`, so that
// programs that do not need them stay as they are. For sides see harness/kernels/ranges.py.
STRUCT(Sided) struct Sided { Interval range; int open; };

bool without_zero(Interval a) {
    return a.lo > 0.0 || a.hi < 0.0;
}

// Rounding makes no error here. The whole line stays the whole line.
Interval interval_floor(Interval a) {
    return make_interval(floor(a.lo), floor(a.hi));
}

// Returns which value the jump number `open` takes: bit number `open` of `sides`.
bool takes_upper(int sides, int open) {
    return ((sides >> open) & 1) == 1;
}

// Returns 0 where floor has one value over a, 1 where it has two, and otherwise a number that is too many.
int open_floor(Interval a) {
    real steps = floor(a.hi) - floor(a.lo);
    return steps == 0.0 ? 0 : (steps == 1.0 ? 1 : 8);
}

// Returns the value that `sides` says, all of them for -1.
Interval sided_floor(Interval a, int sides, int open) {
    Interval b = interval_floor(a);
    if (sides < 0) return b;
    real one = takes_upper(sides, open) ? b.hi : b.lo;
    return make_interval(one, one);
}

Interval interval_sign(Interval a) {
    return make_interval(a.lo >= 0.0 ? real(1) : real(-1), a.hi >= 0.0 ? real(1) : real(-1));
}

// Returns 1 if a <= b everywhere, 0 if nowhere, and [0, 1] otherwise.
Interval interval_below(Interval a, Interval b) {
    return make_interval(a.hi <= b.lo ? real(1) : real(0), a.lo > b.hi ? real(0) : real(1));
}

int open_below(Interval a, Interval b) {
    Interval c = interval_below(a, b);
    return c.lo < c.hi ? 1 : 0;
}

Interval sided_below(Interval a, Interval b, int sides, int open) {
    Interval c = interval_below(a, b);
    if (sides < 0) return c;
    real one = takes_upper(sides, open) ? c.hi : c.lo;
    return make_interval(one, one);
}

// Returns p where the condition c is 1 everywhere, q where it is 0 everywhere, and otherwise what holds both. c is wider
// than that by the rounding of 1 - c, hence the half. The part that is not taken may be anything.
Interval interval_select(Interval c, Interval p, Interval q) {
    if (c.lo > 0.5) return p;
    if (c.hi < 0.5) return q;
    return make_interval(min(p.lo, q.lo), max(p.hi, q.hi));
}
