// Halve [t0, t1] towards the first root, counting roots by the changes of sign along Sturm's chain (toledo2007, 3).
// Row k of the chain is a polynomial of degree SURFACE_DEGREE - k, lowest power first.
#define ROW (SURFACE_DEGREE + 1)
#define CHAIN (ROW * ROW)

void sturm_chain(IN real c[ROW], OUT real chain[CHAIN]) {
    for (int i = 0; i < CHAIN; i++) chain[i] = 0.0;
    for (int i = 0; i <= SURFACE_DEGREE; i++) chain[i] = c[i];
    for (int i = 1; i <= SURFACE_DEGREE; i++) chain[ROW + i - 1] = real(i) * c[i];
    for (int k = 2; k <= SURFACE_DEGREE; k++) {
        int f = (k - 2) * ROW;
        int g = (k - 1) * ROW;
        int n = SURFACE_DEGREE - k + 1;  // degree of g, one less than of f
        real lead = chain[g + n];
        real slope = chain[f + n + 1] / lead;
        real offset = (chain[f + n] - slope * chain[g + n - 1]) / lead;
        chain[k * ROW] = offset * chain[g] - chain[f];
        for (int i = 1; i < n; i++) {
            chain[k * ROW + i] = offset * chain[g + i] + slope * chain[g + i - 1] - chain[f + i];
        }
    }
}

real row_value(IN real chain[CHAIN], int k, real t) {
    real value = chain[k * ROW + SURFACE_DEGREE - k];
    for (int i = SURFACE_DEGREE - k - 1; i >= 0; i--) value = value * t + chain[k * ROW + i];
    return value;
}

// Zeros do not count.
int sign_changes(IN real chain[CHAIN], real t) {
    int changes = 0;
    real last = 0.0;
    for (int k = 0; k <= SURFACE_DEGREE; k++) {
        real value = row_value(chain, k, t);
        if (last * value < 0.0) changes += 1;
        if (value != 0.0) last = value < 0.0 ? -1.0 : 1.0;
    }
    return changes;
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real c[ROW];
    surface_coefficients_along(ray, c);
    real chain[CHAIN];
    sturm_chain(c, chain);
    PRECISE real size = 0.0;
    for (int i = 0; i < CHAIN; i++) size += fabs(chain[i]);
    if (!(size < REAL_INFINITY)) return exhausted(hit, t0);

    int changes_before = sign_changes(chain, t0);
    int changes_after = sign_changes(chain, t1);
    hit.evaluations = 2;
    if (changes_before <= changes_after) return missed(hit);
    bool negative_before = row_value(chain, 0, t0) < 0.0;
    bool negative_after = row_value(chain, 0, t1) < 0.0;
    real a = t0;
    real b = t1;
    int i = 0;
    while (i < ITERATIONS && (BY_SIGN == 0 || changes_before - changes_after > 1 || negative_before == negative_after)) {
        real m = 0.5 * (a + b);
        int changes = sign_changes(chain, m);
        if (changes < changes_before) {
            b = m;
            changes_after = changes;
            negative_after = row_value(chain, 0, m) < 0.0;
        } else {
            a = m;
        }
        i += 1;
    }
    while (i < ITERATIONS) {
        real m = 0.5 * (a + b);
        if ((row_value(chain, 0, m) < 0.0) == negative_before) { a = m; } else { b = m; }
        i += 1;
    }
    hit.evaluations += ITERATIONS;
    return hit_at(hit, 0.5 * (a + b));
}
