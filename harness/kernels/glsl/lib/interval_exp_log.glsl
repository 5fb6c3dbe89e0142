// exp and log of intervals. They are not part of `interval`, since GLSL has neither in float64. Results are widened
// by the error that the GLSL 4.3 or the OpenCL 1.2 (full profile) specification allows, whichever is larger.

// GLSL allows 3 + 2 |a| ulp, OpenCL 3 ulp.
Interval interval_exp(Interval a) {
    return outward(exp(a.lo), exp(a.hi), 8.0 + 4.0 * max(fabs(a.lo), fabs(a.hi)));
}

// Returns the whole line if a holds 0 or less. GLSL allows 3 ulp, or an absolute 2^-21 in [0.5, 2]; OpenCL 3 ulp.
Interval interval_log(Interval a) {
    real absolute = 16.0 * UNIT_ROUNDOFF;
    if (a.lo > 0.0) return outward(log(a.lo) - absolute, log(a.hi) + absolute, 12.0);
    return whole_line();
}
