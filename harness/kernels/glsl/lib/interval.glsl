// Intervals that hold every exact result, without directed rounding. Every interval is finite or the whole line.
//
// A rounded result r of one operation is within u |r| of the exact one (u = UNIT_ROUNDOFF), or within the smallest
// normal number where it underflows. Subtracting 2 u |r| lowers r by at least one unit in its last place, however that
// subtraction rounds, and whether or not fma fuses; REAL_TINY, four times the smallest normal number, beyond it covers
// underflow and flushed denormals. What overflows or is no number becomes the whole line, save in the operations called
// bounded: they are for surfaces and boxes on which nothing overflows (harness/kernels/reach.py).
// Division and sqrt are widened by what the GLSL 4.3 and OpenCL 1.2 (full profile) specifications allow them, whichever
// is more; sin and cos, which GLSL leaves unspecified, are computed here; exp and log are in interval_exp_log.
STRUCT(Interval) struct Interval { real lo; real hi; };

#define INTERVAL_LARGEST_DIVISOR 4.253529586511731e37  // 2^125: a quotient by more is specified less well

Interval make_interval(real lo, real hi) {
    Interval a;
    a.lo = lo;
    a.hi = hi;
    return a;
}

// [lo, hi], or the whole line where an end is not finite. PRECISE: else Mesa takes it that nothing here is NaN.
Interval finite_or_whole(real lo, real hi) {
    PRECISE real width = fabs(hi - lo);
    bool finite = width < REAL_INFINITY;
    return make_interval(finite ? lo : -REAL_INFINITY, finite ? hi : REAL_INFINITY);
}

Interval whole_line() {
    return make_interval(-REAL_INFINITY, REAL_INFINITY);
}

// Holds the exact values whose computed ones are lo and hi, each within k u of its size; finite where they are.
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

// c a, for a number c that is exact (k 1) or rounded to nearest (k 2).
Interval bounded_scale(real c, Interval a, real k) {
    bool turned = c < 0.0;
    return widened_by_rounding(c * (turned ? a.hi : a.lo), c * (turned ? a.lo : a.hi), k);
}

Interval interval_scale(real c, Interval a, real k) {
    return checked(bounded_scale(c, a, k));
}

// o + [t0, t1] d, for numbers o and d: one coordinate of a piece of a ray.
Interval bounded_affine(real o, real d, real t0, real t1) {
    real p = t0 * d;
    real q = t1 * d;
    real product_error = 2.0 * UNIT_ROUNDOFF * max(fabs(p), fabs(q));
    return widened_by_rounding((o + min(p, q)) - product_error, (o + max(p, q)) + product_error, 1.0);
}

// The least absolute value in a.
real interval_mignitude(Interval a) {
    return max(max(a.lo, -a.hi), real(0));
}

// The greatest absolute value in a.
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

// a^n by squaring, n >= 1; within (n - 1) u. Without a loop to n = 31: Mesa ends all of a shader's loops, inner ones too,
// once they have turned 65535 times together, and a marching method takes thousands of powers.
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

// GLSL allows 2.5 ulp. The whole line where b reaches zero.
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

// GLSL: 1 / inversesqrt(a), 2 + 2.5 ulp; OpenCL: 3 ulp. Of the part of a that is not negative; TINY: a flushed denormal.
Interval interval_sqrt(Interval a) {
    if (a.hi >= 0.0) return outward(sqrt(max(a.lo, real(0))), sqrt(a.hi + REAL_TINY), 12.0);
    return whole_line();
}

// sin(x - m pi) for |x| <= 4096 and |m| <= 1304.5, a multiple of a half, so near x / pi that |x - m pi| < 1.6.
// pi in parts of 12, 12, 12 and 24 bits: m times the first three is exact, and so is the first difference; the others
// err by u |x - m pi| each, the truncated series by 2e-18, its sum by at most 8 u. Within 16 u, absolute.
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

#define PER_HALF_TURN 0.31830987334251404  // 1 / pi, rounded: only decides which multiple of pi is near
#define PER_TURN 0.15915493667125702

// sin(x) for offset 0, cos(x) for offset 1/2: within 32 u, absolute, for |x| <= 4096.
real bounded_wave(real x, real offset) {
    real n = floor(x * PER_HALF_TURN + (0.5 - offset));
    real s = reduced_sin(x, n + offset);
    bool even = n == 2.0 * floor(0.5 * n);
    return even == (offset == 0.0) ? s : -s;
}

// sin or cos over a: its ends, and 1 or -1 where a peak or a dip is in a or within 2^-12 of a turn of it.
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
