// Steps of |f| / (bound of how steeply f nears zero) along the ray, from bounds of f's fitted derivative.
#define N SURFACE_DEGREE
#define EVENS (SURFACE_DEGREE / 2 + 1)
#define ODDS ((SURFACE_DEGREE + 1) / 2)

// Bernstein coefficients from samples at the nodes: rows of the inverse for sums and differences of opposite samples.
void fit(IN real s[COEFFICIENTS], OUT real b[COEFFICIENTS]) {
    Factor sums[EVENS];
    Factor differences[ODDS];
    for (int i = 0; i < ODDS; i++) {
        sums[i] = make_factor(two_sum(s[N - i], s[i]));
        differences[i] = make_factor(two_sum(s[N - i], -s[i]));
    }
    if (EVENS > ODDS) sums[EVENS - 1] = make_factor(make_pair(s[N / 2], 0.0));
    for (int r = 0; r < EVENS; r++) {
        Pair even = make_pair(0.0, 0.0);
        Pair odd = make_pair(0.0, 0.0);
        for (int i = 0; i < EVENS; i++) even = plus_product(even, EVEN_HI[r * EVENS + i], EVEN_LO[r * EVENS + i], sums[i]);
        if (r < ODDS) {
            for (int i = 0; i < ODDS; i++) odd = plus_product(odd, ODD_HI[r * ODDS + i], ODD_LO[r * ODDS + i], differences[i]);
        }
        b[r] = (even.hi - odd.hi) + (even.lo - odd.lo);
        b[N - r] = (even.hi + odd.hi) + (even.lo + odd.lo);
    }
}

LowerCurve bounding_curve(IN real b[COEFFICIENTS], int degree) {
    return BOUND == 1 ? lu_curve(b, degree) : control_point_curve(b, degree);
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real reach = t1 - t0;
    real s[COEFFICIENTS];
    for (int i = 0; i <= N; i++) s[i] = surface_value(ray_point(ray, t0 + reach * NODES[i]));
    hit.evaluations = N + 1;
    real b[COEFFICIENTS];
    fit(s, b);
    real sign = s[0] < 0.0 ? real(-1) : real(1);
    for (int j = 0; j <= N; j++) b[j] = sign * b[j];
    if (CULL == 1 && lower_bound(bounding_curve(b, N), N, 0.0, 1.0) > 0.0) return hit;

    real d[COEFFICIENTS];
    for (int j = 0; j < N; j++) d[j] = real(N) * (b[j + 1] - b[j]);
    LowerCurve slope = bounding_curve(d, N - 1);
    real steepest = -lower_bound(slope, N - 1, 0.0, 1.0);
    if (steepest <= 0.0) return hit;
    real window = 1.0;
    real a = 0.0;
    real x = 0.0;
    real fa = sign * s[0];
    real fx = fa;
    while (fx > 0.0) {
        if (x >= 1.0) return hit;
        if (hit.evaluations >= MAX_EVALUATIONS) return exhausted(hit, t0 + reach * x);
        a = x;
        fa = fx;
        if (LOCAL == 1) {
            steepest = -lower_bound(slope, N - 1, x, min(x + window, 1.0));
            real safe = fx < steepest * window ? fx / steepest : window;
            window = 2.0 * max(safe, TOLERANCE);
            x = x + max(safe, TOLERANCE);
        } else {
            x = x + max(fx / steepest, TOLERANCE);
        }
        x = min(x, 1.0);
        fx = sign * surface_value(ray_point(ray, t0 + reach * x));
        hit.evaluations += 1;
    }
    for (int i = 0; i < 4; i++) {
        real m = 0.5 * (a + x);
        real fm = sign * surface_value(ray_point(ray, t0 + reach * m));
        if (fm > 0.0) { a = m; fa = fm; } else { x = m; fx = fm; }
    }
    hit.evaluations += 4;
    return hit_at(hit, t0 + reach * (a + (x - a) * (fa / (fa - fx))));
}
