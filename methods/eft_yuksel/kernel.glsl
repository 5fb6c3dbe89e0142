// Finds the first root of f along the ray between the critical points of its fit (szente, section 2). The fit's
// variable x runs over [-1, 1], or over [0, 1] in the Bernstein basis; t = start + reach x.
#define N SURFACE_DEGREE
#define BERNSTEIN (BASIS == 1)

// Computes the coefficients q of the (N - degree)th derivative of c, which has this degree, up to a common factor.
void derivative(IN real c[COEFFICIENTS], int degree, OUT real q[COEFFICIENTS]) {
    if (BERNSTEIN) {
        for (int j = 0; j <= N; j++) q[j] = c[j];
        for (int m = N; m > degree; m--) {
            for (int j = 0; j < m; j++) q[j] = q[j + 1] - q[j];
        }
        for (int j = 0; j <= degree; j++) q[j] = FACTORS[degree * (N + 1) + j] * q[j];
    } else {
        for (int j = 0; j <= degree; j++) q[j] = FACTORS[degree * (N + 1) + j] * c[N - degree + j];
    }
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real reach = BERNSTEIN ? t1 - t0 : 0.5 * (t1 - t0);
    real start = BERNSTEIN ? t0 : 0.5 * (t0 + t1);
    real s[COEFFICIENTS];
    for (int i = 0; i <= N; i++) s[i] = surface_value(ray_point(ray, start + reach * NODES[i]));
    hit.evaluations = N + 1;
    bool below = s[0] < 0.0;
    real last = NODES[N];
    real at_last = s[N];
    for (int i = N - 1; i > 0; i--) {
        if (SAMPLES == 1 && (s[i] < 0.0) != below) {
            last = NODES[i];
            at_last = s[i];
        }
    }

    real c[COEFFICIENTS];
    real q[COEFFICIENTS];
    real x[COEFFICIENTS];
    if (MATRIX == 1) { fit(s, BERNSTEIN, EFT == 1, c); } else { fit_whole(s, EFT == 1, c); }
    x[0] = NODES[0];
    if (N > 2) {
        derivative(c, 2, q);
        x[3] = last;
        quadratic_roots(x, q, BERNSTEIN);
    } else {
        derivative(c, 1, q);
        x[1] = N == 1 ? last : linear_root(q, BERNSTEIN, NODES[0], last);
        x[2] = last;
    }
    for (int d = 3; d < N; d++) {
        derivative(c, d, q);
        split_at_roots(x, q, d, BERNSTEIN, ISOLATION, START == 0);
    }
    derivative(c, N, q);

    real a = x[0];
    real b = x[0];
    real from = s[0];
    real to = s[0];
    int piece = 1;
    for (int k = 1; k <= N; k++) {
        if ((to < 0.0) == below) {
            piece = k;
            a = b;
            from = to;
            b = x[k];
            if (EVAL == 0) {
                to = polynomial_dual(q, N, BERNSTEIN, b).value;
            } else if (k == N) {
                to = at_last;
            } else {
                to = surface_value(ray_point(ray, start + reach * b));
                hit.evaluations += 1;
            }
        }
    }
    if ((to < 0.0) == below) return hit;
    if (LAST == 0) {
        for (int i = 0; i < MOST_STEPS && b - a > TOLERANCE; i++) {
            real middle = 0.5 * (a + b);
            real f = EVAL == 1 ? surface_value(ray_point(ray, start + reach * middle))
                               : polynomial_dual(q, N, BERNSTEIN, middle).value;
            hit.evaluations += EVAL;
            if ((f < 0.0) == below) { a = middle; } else { b = middle; }
        }
        return hit_at(hit, start + reach * (0.5 * (a + b)));
    }
    Bracket bracket = START == 1 ? make_end_bracket(a, b, from, to, piece, N) : bracket_from(a, b, 0.5);
    for (int i = 0; i < MOST_STEPS && bracket.step > TOLERANCE; i++) {
        Dual f = polynomial_dual(q, N, BERNSTEIN, bracket.x);
        if (EVAL == 1) f.value = surface_value(ray_point(ray, start + reach * bracket.x));
        hit.evaluations += EVAL;
        bracket = newton_step(bracket, f, below);
    }
    return hit_at(hit, start + reach * bracket.x);
}
