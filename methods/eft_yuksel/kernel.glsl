// The first root of f along the ray, between the critical points of its fit (szente, section 2). The fit's variable x
// runs over [-1, 1], or over [0, 1] in the Bernstein basis; t = start + reach x.
#define N SURFACE_DEGREE
#define EVENS (SURFACE_DEGREE / 2 + 1)
#define ODDS ((SURFACE_DEGREE + 1) / 2)
#define BERNSTEIN (BASIS == 1)

Factor sum_factor(real a, real b) {
    return make_factor(EFT == 1 ? two_sum(a, b) : make_pair(a + b, 0.0));
}

Pair next_sum(Pair sum, real hi, real lo, Factor b) {
    return EFT == 1 ? plus_product(sum, hi, lo, b) : make_pair(sum.hi + hi * b.hi, 0.0);
}

Pair even_row(IN Factor sums[EVENS], int row) {
    Pair sum = make_pair(0.0, 0.0);
    for (int i = 0; i < EVENS; i++) sum = next_sum(sum, EVEN_HI[row * EVENS + i], EVEN_LO[row * EVENS + i], sums[i]);
    return sum;
}

Pair odd_row(IN Factor differences[ODDS], int row) {
    Pair sum = make_pair(0.0, 0.0);
    for (int i = 0; i < ODDS; i++) sum = next_sum(sum, ODD_HI[row * ODDS + i], ODD_LO[row * ODDS + i], differences[i]);
    return sum;
}

// Coefficients from samples at the nodes: rows of the inverse for sums and differences of opposite samples.
void fit(IN real s[COEFFICIENTS], OUT real c[COEFFICIENTS]) {
    Factor sums[EVENS];
    Factor differences[ODDS];
    for (int i = 0; i < ODDS; i++) {
        sums[i] = sum_factor(s[N - i], s[i]);
        differences[i] = sum_factor(s[N - i], -s[i]);
    }
    if (EVENS > ODDS) sums[EVENS - 1] = sum_factor(s[N / 2], 0.0);
    for (int r = 0; r < ODDS; r++) {
        Pair even = even_row(sums, r);
        Pair odd = odd_row(differences, r);
        if (BERNSTEIN) {
            c[r] = (even.hi - odd.hi) + (even.lo - odd.lo);
            c[N - r] = (even.hi + odd.hi) + (even.lo + odd.lo);
        } else {
            c[2 * r] = even.hi + even.lo;
            c[2 * r + 1] = odd.hi + odd.lo;
        }
    }
    if (EVENS > ODDS) {
        Pair even = even_row(sums, EVENS - 1);
        c[BERNSTEIN ? N / 2 : N] = even.hi + even.lo;
    }
}

// The coefficients of c's (N - degree)th derivative, up to one factor.
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
    for (int i = N - 1; i > 0; i--) { if ((s[i] < 0.0) != below) last = NODES[i]; }

    real c[COEFFICIENTS];
    real q[COEFFICIENTS];
    real x[COEFFICIENTS];
    fit(s, c);
    derivative(c, 1, q);
    x[0] = NODES[0];
    x[1] = N == 1 ? last : linear_root(q, BERNSTEIN, NODES[0], last);
    x[2] = last;
    for (int d = 2; d < N; d++) {
        derivative(c, d, q);
        split_at_roots(x, q, d, BERNSTEIN, ISOLATION);
    }
    derivative(c, N, q);

    real a = x[0];
    real b = x[0];
    real from = s[0];
    real to = s[0];
    for (int k = 1; k <= N; k++) {
        if ((to < 0.0) == below) {
            a = b;
            from = to;
            b = x[k];
            if (EVAL == 1) {
                to = surface_value(ray_point(ray, start + reach * b));
            } else {
                to = polynomial_dual(q, N, BERNSTEIN, b).value;
            }
            hit.evaluations += EVAL;
        }
    }
    if ((to < 0.0) == below) return hit;
    Bracket bracket = make_bracket(a, b, from, to);
    for (int i = 0; i < MOST_STEPS && bracket.step > TOLERANCE; i++) {
        Dual f = polynomial_dual(q, N, BERNSTEIN, bracket.x);
        if (EVAL == 1) f.value = surface_value(ray_point(ray, start + reach * bracket.x));
        hit.evaluations += EVAL;
        bracket = newton_step(bracket, f, below);
    }
    return hit_at(hit, start + reach * bracket.x);
}
