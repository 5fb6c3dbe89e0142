// Marches along the ray, as x in [0, 1], by steps of |f| over a bound of the slope with which f falls towards zero
// (szente, section 3).
#define N SURFACE_DEGREE
#define SHELLS 16  // sizes of the tables VALUE_ERRORS and SLOPE_GROWTH
#define DEPTHS 6
#define FINEST 4.0  // least length of a step, in unit roundoffs of the ray's length: below it x may stand still

// Computes the coefficients e on [x, x + width] of the polynomial that has the coefficients d on [0, 1], by two runs of
// de Casteljau's algorithm.
void restrict_to(real x, real width, IN real d[COEFFICIENTS], int degree, OUT real e[COEFFICIENTS]) {
    for (int j = 0; j <= degree; j++) e[j] = d[j];
    for (int r = 1; r <= degree; r++) {
        for (int j = 0; j <= degree - r; j++) e[j] = e[j] + x * (e[j + 1] - e[j]);
    }
    real share = width / (1.0 - x);
    for (int r = 1; r <= degree; r++) {
        for (int j = degree; j >= r; j--) {
            real before = e[j - 1];  // read only once: Mesa 22.3 miscompiles this line with two reads of e[j - 1]
            e[j] = before + share * (e[j] - before);
        }
    }
}

LowerCurve bound_of(IN real b[COEFFICIENTS], int degree) {
    if (BOUND == 1) return lu_curve(b, degree);
    return control_point_curve(b, degree);
}

LowerCurve bound_of_negative(IN real b[COEFFICIENTS], int degree) {
    real negative[COEFFICIENTS];
    for (int j = 0; j <= degree; j++) negative[j] = -b[j];
    return bound_of(negative, degree);
}

// Returns a lower bound of the polynomial on [0, 1] or, with LOCAL 2, on [a, b]: a curve whose lowest point lies
// outside [a, b] is lowest at the nearer end of it. The curve's own rounding errors count unless TRUST is 0.
real least_value(LowerCurve curve, real a, real b, int degree) {
    real lowest_at = LOCAL == 2 ? clamp(curve.lowest_at, a, b) : curve.lowest_at;
    return curve_value(curve, lowest_at, degree) - (TRUST > 0.0 ? curve_error(curve, degree) : real(0));
}

// Returns an upper bound of the slope with which f falls on the same interval or, with SIDES 2, falls or rises.
// `falling` is nowhere above f's derivative, `rising` nowhere above the derivative's negative. `degree` is the
// derivative's.
real steepest_slope(LowerCurve falling, LowerCurve rising, real a, real b, int degree) {
    real slope = -least_value(falling, a, b, degree);
    return SIDES == 2 ? max(slope, -least_value(rising, a, b, degree)) : slope;
}

real largest(IN real b[COEFFICIENTS], int degree) {
    real size = 0.0;
    for (int j = 0; j <= degree; j++) size = max(size, fabs(b[j]));
    return size;
}

// Bounds the error of a computed value of f at a squared distance of at most `away` from the domain's centre: TRUST of
// the worst case of the rounding errors of f and of the point's coordinates.
real value_error(real away) {
    int shell = min(int(sqrt(max(away, real(0))) * (real(SHELLS) / DOMAIN_RADIUS)), SHELLS - 1);
    return TRUST * UNIT_ROUNDOFF * VALUE_ERRORS[shell];
}

// Bounds the error of the fit's coefficients, which are at most `size`, where samples are off by at most `off`.
real coefficient_error(real off, real size) {
    if (TRUST == 0.0) return 0.0;
    return GROWTH[0] * off + 6.0 * UNIT_ROUNDOFF * size;
}

// Bounds the error of the derivative's coefficients, which are at most `slope`, on a piece of at most `window` of the
// ray's interval. It holds the differences of the fit's rounding errors, and two roundings for each step of
// restrict_to.
real slope_error(real off, real size, real slope, real window) {
    if (TRUST == 0.0) return 0.0;
    real growth = SLOPE_GROWTH[0];
    real piece = 1.0;
    for (int k = 1; k <= DEPTHS; k++) {
        piece = 0.5 * piece;
        growth = window <= piece ? SLOPE_GROWTH[k] : growth;
    }
    return growth * off + UNIT_ROUNDOFF * (real(12 * N) * size + real(10 * N) * slope);
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real reach = t1 - t0;
    real s[COEFFICIENTS];
    for (int i = 0; i <= N; i++) s[i] = surface_value(ray_point(ray, t0 + reach * NODES[i]));
    hit.evaluations = N + 1;
    real b[COEFFICIENTS];
    if (MATRIX == 1) { fit(s, true, true, b); } else { fit_whole(s, true, b); }
    real sign = s[0] < 0.0 ? real(-1) : real(1);
    for (int j = 0; j <= N; j++) b[j] = sign * b[j];
    vec3 from_center = difference(ray.origin, DOMAIN_CENTER);  // its square at t: near + (drift + t) t
    real near = inner_product(from_center, from_center);
    real drift = 2.0 * inner_product(from_center, ray.direction);
    real off = value_error(near + max((drift + t0) * t0, (drift + t1) * t1));
    real size = largest(b, N);
    if (CULL == 1 && least_value(bound_of(b, N), 0.0, 1.0, N) > coefficient_error(off, size)) return hit;

    real d[COEFFICIENTS];
    real e[COEFFICIENTS];
    for (int j = 0; j < N; j++) d[j] = real(N) * (b[j + 1] - b[j]);
    real slope = largest(d, N - 1);
    LowerCurve falling = bound_of(d, N - 1);
    LowerCurve rising = falling;
    if (SIDES == 2) rising = bound_of_negative(d, N - 1);
    real steepest = slope_error(off, size, slope, 1.0) + steepest_slope(falling, rising, 0.0, 1.0, N - 1);
    real shortest = max(TOLERANCE, FINEST * UNIT_ROUNDOFF);
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
            falling = bound_of(e, N - 1);
            if (SIDES == 2) rising = bound_of_negative(e, N - 1);
            steepest = slope_error(off, size, slope, window) + steepest_slope(falling, rising, 0.0, 1.0, N - 1);
        }
        if (LOCAL == 2 && window < 1.0) {
            steepest = slope_error(off, size, slope, 1.0) + steepest_slope(falling, rising, x, x + window, N - 1);
        }
        real step = max(shortest, fx < steepest * window ? fx / steepest : window);
        a = x;
        fa = fx;
        x = min(x + step, 1.0);
        fx = sign * surface_value(ray_point(ray, t0 + reach * x));
        hit.evaluations += 1;
        window = LOCAL > 0 ? min(2.0 * step, 1.0 - x) : 1.0;
    }
    if (!(fx <= 0.0)) return exhausted(hit, t0 + reach * x);
    return hit_at(hit, t0 + reach * (fx < fa ? a + (x - a) * (fa / (fa - fx)) : x));
}
