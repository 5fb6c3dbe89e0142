// Real powers of intervals. They are a file of their own, since GLSL has no pow in float64.

// Returns how many unit roundoffs pow(a, q) may be wrong by, relative to its size. OpenCL allows 16 ulp. GLSL allows
// exp2(q log2(a)): exp2 is off by 3 + 2 |x| ulp at x = q log2(a), and x itself by |q| times 2^-21 or 3 ulp of log2(a),
// and by the roundings of product and q. That is less than 6 |q| + 12 |x| + 8 unit roundoffs.
real powr_error(real a, real q) {
    return 32.0 + 8.0 * q + 16.0 * fabs(q * log2(a));
}

// Returns a^q for a > 0, and 0 for a = 0. A denormal a may be taken for 0.
real powr_end(real a, real q) {
    return a > 0.0 ? pow(a, q) : real(0);
}

// Returns a^q of the part of a that is not negative, for q > 0; the whole line if there is none.
Interval interval_powr(Interval a, real q) {
    if (a.hi >= 0.0) {
        real hi = a.hi + REAL_TINY;
        Interval least = a.lo > REAL_TINY ? outward(powr_end(a.lo, q), 0.0, powr_error(a.lo, q)) : make_interval(0.0, 0.0);
        Interval most = outward(0.0, powr_end(hi, q), powr_error(hi, q));
        return finite_or_whole(max(least.lo, real(0)), most.hi);
    }
    return whole_line();
}
