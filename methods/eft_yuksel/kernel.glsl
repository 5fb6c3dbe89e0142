#define N SURFACE_DEGREE
#define EVENS (SURFACE_DEGREE / 2 + 1)
#define ODDS ((SURFACE_DEGREE + 1) / 2)

void fit(IN real s[N + 1], OUT real c[N + 1]) {
    Factor sums[EVENS];
    Factor differences[ODDS];
    for (int i = 0; i < ODDS; i++) {
        sums[i] = make_factor(two_sum(s[N - i], s[i]));
        differences[i] = make_factor(two_sum(s[N - i], -s[i]));
    }
    if (EVENS > ODDS) sums[EVENS - 1] = make_factor(make_pair(s[N / 2], 0.0));
    for (int r = 0; r < EVENS; r++) {
        Pair sum = make_pair(0.0, 0.0);
        for (int i = 0; i < EVENS; i++) sum = plus_product(sum, EVEN_HI[r * EVENS + i], EVEN_LO[r * EVENS + i], sums[i]);
        c[2 * r] = sum.hi + sum.lo;
    }
    for (int r = 0; r < ODDS; r++) {
        Pair sum = make_pair(0.0, 0.0);
        for (int i = 0; i < ODDS; i++) sum = plus_product(sum, ODD_HI[r * ODDS + i], ODD_LO[r * ODDS + i], differences[i]);
        c[2 * r + 1] = sum.hi + sum.lo;
    }
}

// The root of q in [a, b], where q is monotone and changes sign; Newton's steps, kept inside by halving.
real bracketed_root(IN real q[N + 1], int degree, real a, real b, bool rising) {
    real x = 0.5 * (a + b);
    for (int i = 0; i < 40; i++) {
        real value = q[degree];
        real slope = 0.0;
        for (int j = degree - 1; j >= 0; j--) { slope = slope * x + value; value = value * x + q[j]; }
        if ((value < 0.0) == rising) { a = x; } else { b = x; }
        real next = x - value / slope;
        if (!(next > a && next < b)) next = 0.5 * (a + b);
        bool done = fabs(next - x) < TOLERANCE;
        x = next;
        if (done) break;
    }
    return x;
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real middle = 0.5 * (t0 + t1);
    real reach = 0.5 * (t1 - t0);
    real s[N + 1];
    for (int i = 0; i <= N; i++) s[i] = surface_value(ray_point(ray, middle + reach * NODES[i]));
    hit.evaluations = N + 1;
    real last = 1.0;
    for (int i = N; i > 0; i--) { if ((s[i] < 0.0) != (s[0] < 0.0)) last = NODES[i]; }

    real c[N + 1];
    fit(s, c);
    real x[N + 1];
    real q[N + 1];
    x[0] = -1.0;
    x[1] = last;
    for (int d = 1; d < N; d++) {
        for (int j = 0; j <= d; j++) q[j] = FACTORS[d * (N + 1) + j] * c[N - d + j];
        real a = -1.0;
        real va = q[d];
        for (int j = d - 1; j >= 0; j--) va = va * a + q[j];
        for (int k = 1; k <= d; k++) {
            real b = x[k];
            real vb = q[d];
            for (int j = d - 1; j >= 0; j--) vb = vb * b + q[j];
            if ((va < 0.0) != (vb < 0.0)) x[k] = bracketed_root(q, d, a, b, va < 0.0);
            a = b;
            va = vb;
        }
        x[d + 1] = last;
    }

    bool below = s[0] < 0.0;
    real a = -1.0;
    real b = -1.0;
    bool found = false;
    for (int k = 1; k <= N; k++) {
        if (!found) {
            a = b;
            b = x[k];
            if (b > a) {
                real f = surface_value(ray_point(ray, middle + reach * b));
                hit.evaluations += 1;
                found = (f < 0.0) != below;
            }
        }
    }
    if (!found) return hit;
    a = middle + reach * a;
    b = middle + reach * b;
    for (int i = 0; i < 24; i++) {
        real m = 0.5 * (a + b);
        if ((surface_value(ray_point(ray, m)) < 0.0) == below) { a = m; } else { b = m; }
    }
    hit.evaluations += 24;
    return hit_at(hit, 0.5 * (a + b));
}
