// Steps of |f| over a bound of how steeply f nears zero, along the ray as x in [0, 1]; szente, section 3.
#define N SURFACE_DEGREE

// Coefficients on [x, x + width] of the polynomial with coefficients d on [0, 1]: de Casteljau's algorithm, twice.
void restrict_to(real x, real width, IN real d[COEFFICIENTS], int degree, OUT real e[COEFFICIENTS]) {
    for (int j = 0; j <= degree; j++) e[j] = d[j];
    for (int r = 1; r <= degree; r++) {
        for (int j = 0; j <= degree - r; j++) e[j] = e[j] + x * (e[j + 1] - e[j]);
    }
    real share = width / (1.0 - x);
    for (int r = 1; r <= degree; r++) {
        for (int j = degree; j >= r; j--) {
            real before = e[j - 1];  // named once: reading e[j - 1] twice here is miscompiled by Mesa 22.3
            e[j] = before + share * (e[j] - before);
        }
    }
}

real least_value(IN real b[COEFFICIENTS], int degree) {
    return lower_bound(BOUND == 1 ? lu_curve(b, degree) : control_point_curve(b, degree), degree);
}

// A bound of how steeply the polynomial with the derivative's coefficients d falls, or (SIDES 2) falls or rises.
real steepest_slope(IN real d[COEFFICIENTS], int degree) {
    real slope = -least_value(d, degree);
    if (SIDES == 2) {
        real negative[COEFFICIENTS];
        for (int j = 0; j <= degree; j++) negative[j] = -d[j];
        slope = max(slope, -least_value(negative, degree));
    }
    return slope;
}

// More than what fitting and restricting err by.
real error_bound(IN real b[COEFFICIENTS], int degree) {
    real largest = 0.0;
    for (int j = 0; j <= degree; j++) largest = max(largest, fabs(b[j]));
    return real(8 * N) * UNIT_ROUNDOFF * largest;
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real reach = t1 - t0;
    real s[COEFFICIENTS];
    for (int i = 0; i <= N; i++) s[i] = surface_value(ray_point(ray, t0 + reach * NODES[i]));
    hit.evaluations = N + 1;
    real b[COEFFICIENTS];
    fit(s, true, true, b);
    real sign = s[0] < 0.0 ? real(-1) : real(1);
    for (int j = 0; j <= N; j++) b[j] = sign * b[j];
    if (CULL == 1 && least_value(b, N) > error_bound(b, N)) return hit;

    real d[COEFFICIENTS];
    real e[COEFFICIENTS];
    for (int j = 0; j < N; j++) d[j] = real(N) * (b[j + 1] - b[j]);
    real error = error_bound(d, N - 1);
    real steepest = error + steepest_slope(d, N - 1);
    real window = 1.0;
    real a = 0.0;
    real x = 0.0;
    real fa = sign * s[0];
    real fx = fa;
    while (!(fx <= 0.0)) {
        if (x >= 1.0) return hit;
        if (hit.evaluations >= MAX_EVALUATIONS) return exhausted(hit, t0 + reach * x);
        if (LOCAL == 1 && window < 1.0) {
            restrict_to(x, window, d, N - 1, e);
            steepest = error + steepest_slope(e, N - 1);
        }
        real step = max(TOLERANCE, fx < steepest * window ? fx / steepest : window);
        a = x;
        fa = fx;
        x = min(x + step, 1.0);
        fx = sign * surface_value(ray_point(ray, t0 + reach * x));
        hit.evaluations += 1;
        window = LOCAL == 1 ? min(2.0 * step, 1.0 - x) : 1.0;
    }
    if (!(fx <= 0.0)) return exhausted(hit, t0 + reach * x);
    return hit_at(hit, t0 + reach * (fx < fa ? a + (x - a) * (fa / (fa - fx)) : x));
}
