// Finds the first root of f's exact expansion along the ray, between its critical points (Yuksel 2022).
#define N SURFACE_DEGREE

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real exact[SURFACE_DEGREE + 1];
    real c[COEFFICIENTS];
    real q[COEFFICIENTS];
    real x[COEFFICIENTS];
    surface_coefficients_along(ray, exact);
    for (int j = 0; j <= N; j++) c[j] = exact[j];
    x[0] = t0;
    if (N > 2) {
        for (int j = 0; j <= 2; j++) q[j] = FACTORS[2 * (N + 1) + j] * c[N - 2 + j];
        x[3] = t1;
        quadratic_roots(x, q, false);
    } else {
        for (int j = 0; j <= 1; j++) q[j] = FACTORS[N + 1 + j] * c[N - 1 + j];
        x[1] = N == 1 ? t1 : linear_root(q, false, t0, t1);
        x[2] = t1;
    }
    for (int d = 3; d < N; d++) {
        for (int j = 0; j <= d; j++) q[j] = FACTORS[d * (N + 1) + j] * c[N - d + j];
        split_at_roots(x, q, d, false, ISOLATION * (t1 - t0), START == 0);
    }

    real a = t0;
    real b = t0;
    real from = polynomial_dual(c, N, false, t0).value;
    real to = from;
    bool below = from < 0.0;
    hit.evaluations = 1;
    int piece = 1;
    for (int k = 1; k <= N; k++) {
        if ((to < 0.0) == below) {
            piece = k;
            a = b;
            from = to;
            b = x[k];
            to = polynomial_dual(c, N, false, b).value;
            hit.evaluations += 1;
        }
    }
    if ((to < 0.0) == below) return hit;
    Bracket bracket = START == 1 ? make_end_bracket(a, b, from, to, piece, N) : bracket_from(a, b, 0.5);
    for (int i = 0; i < MOST_STEPS && bracket.step > TOLERANCE * (t1 - t0); i++) {
        bracket = newton_step(bracket, polynomial_dual(c, N, false, bracket.x), below);
        hit.evaluations += 1;
    }
    return hit_at(hit, bracket.x);
}
