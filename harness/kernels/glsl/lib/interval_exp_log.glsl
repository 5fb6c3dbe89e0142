// exp and log of intervals; apart from `interval`, since GLSL has neither in float64. Widened by what the GLSL 4.3 and
// OpenCL 1.2 (full profile) specifications allow the device's own functions, whichever is more.

// GLSL: 3 + 2 |a| ulp; OpenCL: 3 ulp.
Interval interval_exp(Interval a) {
    return outward(exp(a.lo), exp(a.hi), 8.0 + 4.0 * max(fabs(a.lo), fabs(a.hi)));
}

// GLSL: 3 ulp, or 2^-21 absolute in [0.5, 2]; OpenCL: 3 ulp. The whole line where a reaches zero.
Interval interval_log(Interval a) {
    real absolute = 16.0 * UNIT_ROUNDOFF;
    if (a.lo > 0.0) return outward(log(a.lo) - absolute, log(a.hi) + absolute, 12.0);
    return whole_line();
}
