// Interval arithmetic without directed rounding: every result holds all exact results. Every interval is finite or the
// whole line.
//
// The rounded result r of one operation is within u |r| of the exact one (u = UNIT_ROUNDOFF), or within the smallest
// normal number if it underflows. Subtracting 2 u |r| lowers r by at least one unit in its last place, however that
// subtraction rounds, and whether or not fma fuses. Subtracting REAL_TINY, four times the smallest normal number, as
// well covers underflow and flushed denormals. An interval that overflows or is not a number becomes the whole line,
// except in the operations called bounded: these are for surfaces and boxes on which nothing overflows, see
// harness/kernels/reach.py.
//
// Division and sqrt are widened by the error that the GLSL 4.3 or the OpenCL 1.2 (full profile) specification allows,
// whichever is larger. sin and cos, whose errors GLSL does not specify, are computed here; exp and log are in
// interval_exp_log.
STRUCT(Interval) struct Interval { real lo; real hi; };

#define INTERVAL_LARGEST_DIVISOR 4.253529586511731e37  // 2^125: the specifications allow larger errors beyond it

Interval make_interval(real lo, real hi) {
    Interval a;
    a.lo = lo;
    a.hi = hi;
    return a;
}

// Returns [lo, hi], or the whole line if an end is not finite. Without PRECISE, Mesa assumes that nothing here is NaN.
Interval finite_or_whole(real lo, real hi) {
    PRECISE real width = fabs(hi - lo);
    bool finite = width < REAL_INFINITY;
    return make_interval(finite ? lo : -REAL_INFINITY, finite ? hi : REAL_INFINITY);
}

Interval whole_line() {
    return make_interval(-REAL_INFINITY, REAL_INFINITY);
}

// Returns an interval that holds the exact values of the computed lo and hi, which are each wrong by at most k u times
// their size. It is finite if lo and hi are.
Interval widened_by_rounding(real lo, real hi, real k) {
    real relative = 2.0 * k * UNIT_ROUNDOFF;
    return make_interval(fma(fabs(lo), -relative, lo) - REAL_TINY, fma(fabs(hi), relative, hi) + REAL_TINY);
}

Interval checked(Interval a) {
    return finite_or_whole(a.lo, a.hi);
}

Interval outward(real lo, real hi, real k) {
    return checked(widened_by_rounding(lo, hi, k));
}

Interval interval_neg(Interval a) {
    return make_interval(-a.hi, -a.lo);
}

Interval bounded_add(Interval a, Interval b) {
    return widened_by_rounding(a.lo + b.lo, a.hi + b.hi, 1.0);
}

Interval interval_add(Interval a, Interval b) {
    return checked(bounded_add(a, b));
}

Interval bounded_sub(Interval a, Interval b) {
    return widened_by_rounding(a.lo - b.hi, a.hi - b.lo, 1.0);
}

Interval interval_sub(Interval a, Interval b) {
    return checked(bounded_sub(a, b));
}

Interval bounded_mul(Interval a, Interval b) {
    real p = a.lo * b.lo;
    real q = a.lo * b.hi;
    real r = a.hi * b.lo;
    real s = a.hi * b.hi;
    return widened_by_rounding(min(min(p, q), min(r, s)), max(max(p, q), max(r, s)), 1.0);
}

Interval interval_mul(Interval a, Interval b) {
    return checked(bounded_mul(a, b));
}

// Returns c a for a number c; k is 1 if c is exact, 2 if it is rounded to nearest.
Interval bounded_scale(real c, Interval a, real k) {
    bool turned = c < 0.0;
    return widened_by_rounding(c * (turned ? a.hi : a.lo), c * (turned ? a.lo : a.hi), k);
}

Interval interval_scale(real c, Interval a, real k) {
    return checked(bounded_scale(c, a, k));
}

// Returns o + [t0, t1] d for numbers o and d, which is one coordinate of a piece of a ray.
Interval bounded_affine(real o, real d, real t0, real t1) {
    real p = t0 * d;
    real q = t1 * d;
    real product_error = 2.0 * UNIT_ROUNDOFF * max(fabs(p), fabs(q));
    return widened_by_rounding((o + min(p, q)) - product_error, (o + max(p, q)) + product_error, 1.0);
}

// Returns the least absolute value in a.
real interval_mignitude(Interval a) {
    return max(max(a.lo, -a.hi), real(0));
}

// Returns the greatest absolute value in a.
real interval_magnitude(Interval a) {
    return max(-a.lo, a.hi);
}

Interval interval_abs(Interval a) {
    return finite_or_whole(interval_mignitude(a), interval_magnitude(a));
}

Interval bounded_sqr(Interval a) {
    real least = interval_mignitude(a);
    real greatest = interval_magnitude(a);
    return widened_by_rounding(least * least, greatest * greatest, 1.0);
}

Interval interval_sqr(Interval a) {
    return checked(bounded_sqr(a));
}

bool is_odd(int n) {
    return n - 2 * (n / 2) == 1;
}

// Returns a^n by squaring, n >= 1, with a relative error within (n - 1) u. Up to n = 31 it has no loop: Mesa ends all
// loops of a shader, inner ones too, once they have turned 65,535 times together, and a marching method takes
// thousands of powers.
real whole_power(real a, int n) {
    real power = is_odd(n) ? a : real(1);
    real square = a * a;
    if (is_odd(n / 2)) power = power * square;
    square = square * square;
    if (is_odd(n / 4)) power = power * square;
    square = square * square;
    if (is_odd(n / 8)) power = power * square;
    square = square * square;
    if (is_odd(n / 16)) power = power * square;
    for (int k = n / 32; k > 0; k = k / 2) {
        square = square * square;
        if (is_odd(k)) power = power * square;
    }
    return power;
}

Interval bounded_powi(Interval a, int n) {
    if (is_odd(n)) return widened_by_rounding(whole_power(a.lo, n), whole_power(a.hi, n), real(n));
    return widened_by_rounding(whole_power(interval_mignitude(a), n), whole_power(interval_magnitude(a), n), real(n));
}

Interval interval_powi(Interval a, int n) {
    return checked(bounded_powi(a, n));
}

// Returns the whole line if b holds 0 or is too large. GLSL allows 2.5 ulp, OpenCL as much.
Interval interval_div(Interval a, Interval b) {
    if (interval_mignitude(b) > 0.0 && interval_magnitude(b) < INTERVAL_LARGEST_DIVISOR) {
        real p = a.lo / b.lo;
        real q = a.lo / b.hi;
        real r = a.hi / b.lo;
        real s = a.hi / b.hi;
        return outward(min(min(p, q), min(r, s)), max(max(p, q), max(r, s)), 8.0);
    }
    return whole_line();
}

Interval interval_min(Interval a, Interval b) {
    return finite_or_whole(min(a.lo, b.lo), min(a.hi, b.hi));
}

Interval interval_max(Interval a, Interval b) {
    return finite_or_whole(max(a.lo, b.lo), max(a.hi, b.hi));
}

// Returns the roots of the part of a that is not negative; the whole line if there is none. GLSL allows sqrt as
// 1 / inversesqrt(a), 2 + 2.5 ulp; OpenCL 3 ulp. REAL_TINY is added for denormals, which may be flushed to 0.
Interval interval_sqrt(Interval a) {
    if (a.hi >= 0.0) return outward(sqrt(max(a.lo, real(0))), sqrt(a.hi + REAL_TINY), 12.0);
    return whole_line();
}

// Returns sin(x - m pi) with an absolute error within 16 u, for |x| <= 4096 and a multiple m of a half with |m| <=
// 1304.5 and |x - m pi| < 1.6. pi is taken in parts of 12, 12, 12 and 24 bits. m times the first three is exact, and
// so is the first difference; the other differences are wrong by u |x - m pi| each, the truncated series by 2e-18,
// and its sum by at most 8 u.
real reduced_sin(real x, real m) {
    PRECISE real r1 = x - m * 3.140625;
    PRECISE real r2 = r1 - m * 9.67502593994140625e-4;
    PRECISE real r3 = r2 - m * 1.50990672409534454e-7;
    PRECISE real r = r3 - m * 5.12668824e-12;
    real square = r * r;
    real sum = 1.0;
    for (int k = 20; k >= 2; k = k - 2) sum = 1.0 - sum * square / real(k * (k + 1));
    return r * sum;
}

#define PER_HALF_TURN 0.31830987334251404  // 1 / pi, rounded: it only decides which multiple of pi is near
#define PER_TURN 0.15915493667125702

// Returns sin(x) for offset 0, cos(x) for offset 1/2, with an absolute error within 32 u for |x| <= 4096.
real bounded_wave(real x, real offset) {
    real n = floor(x * PER_HALF_TURN + (0.5 - offset));
    real s = reduced_sin(x, n + offset);
    bool even = n == 2.0 * floor(0.5 * n);
    return even == (offset == 0.0) ? s : -s;
}

// Returns the range of sin (offset 0) or cos (offset 1/2) over a: from the values at its ends, and 1 or -1 if a
// maximum or a minimum is in a or within 2^-12 of a turn of it.
Interval interval_wave(Interval a, real offset) {
    if (a.lo > -4096.0 && a.hi < 4096.0) {
        real error = 32.0 * UNIT_ROUNDOFF;
        real p = bounded_wave(a.lo, offset);
        real q = bounded_wave(a.hi, offset);
        real from_peak = a.lo * PER_TURN - (0.25 - 0.5 * offset) - 0.000244140625;
        real to_peak = a.hi * PER_TURN - (0.25 - 0.5 * offset) + 0.000244140625;
        bool peak = floor(to_peak) >= from_peak;
        bool dip = floor(to_peak - 0.5) >= from_peak - 0.5;
        return make_interval(dip ? real(-1) : max(min(p, q) - error, real(-1)),
                             peak ? real(1) : min(max(p, q) + error, real(1)));
    }
    return make_interval(-1.0, 1.0);
}

Interval interval_sin(Interval a) {
    return interval_wave(a, 0.0);
}

Interval interval_cos(Interval a) {
    return interval_wave(a, 0.5);
}

Interval interval_tan(Interval a) {
    return interval_div(interval_sin(a), interval_cos(a));
}
