// Halves [t0, t1] towards the first root. Roots are counted by the changes of sign along Sturm's chain (toledo2007,
// section 3). Row k of the chain is a polynomial in x of degree at most SURFACE_DEGREE - k, lowest power first;
// t = middle + reach x.
#define ROW (SURFACE_DEGREE + 1)
#define CHAIN (ROW * (ROW + 1) / 2)

// Returns where row k begins. Rows lie one behind the other without the zeros of missing powers: with rows of equal
// length llvmpipe compiles four times as long (17 s at degree 16).
int row_start(int k) {
    return k * (2 * ROW - k + 1) / 2;
}

// Computes the chain as printed, for degrees to 4: each division of one row by the next leaves one degree less. Returns
// whether each leading coefficient that was divided by has more than the share SHARE of its row for |x| <= reach;
// otherwise the remainder is nothing but rounding errors.
bool sturm_chain(IN real c[ROW], real reach, OUT real chain[CHAIN]) {
    for (int i = 0; i < CHAIN; i++) chain[i] = 0.0;
    for (int i = 0; i <= SURFACE_DEGREE; i++) chain[i] = c[i];
    for (int i = 1; i <= SURFACE_DEGREE; i++) chain[ROW + i - 1] = real(i) * c[i];
    bool led = true;
    real inverse = 1.0 / reach;
    for (int k = 2; k <= SURFACE_DEGREE; k++) {
        int f = row_start(k - 2);
        int g = row_start(k - 1);
        int n = SURFACE_DEGREE - k + 1;  // degree of g; that of f is n + 1
        int rest = row_start(k);
        real lead = chain[g + n];
        real below = 0.0;  // bound of the row's other terms for |x| <= reach, over reach^(n - 1)
        for (int i = 0; i < n; i++) below = below * inverse + fabs(chain[g + i]);
        led = led && fabs(lead) * reach > SHARE * below;
        real slope = chain[f + n + 1] / lead;
        real offset = (chain[f + n] - slope * chain[g + n - 1]) / lead;
        chain[rest] = offset * chain[g] - chain[f];
        for (int i = 1; i < n; i++) {
            chain[rest + i] = offset * chain[g + i] + slope * chain[g + i - 1] - chain[f + i];
        }
    }
    return led;
}

// Computes the chain beyond degree 4. Each coefficient has two parts, and each row is divided by its largest
// coefficient. A leading coefficient that is nothing but rounding counts as 0, and so does a row of such coefficients.
void scaled_chain(IN real c[ROW], OUT real chain[CHAIN]) {
    Pair f[ROW];
    Pair g[ROW];
    for (int i = 0; i < CHAIN; i++) chain[i] = 0.0;
    for (int i = 0; i < ROW; i++) {
        f[i] = make_pair(0.0, 0.0);
        g[i] = make_pair(c[i], 0.0);
    }
    int p = 0;
    int q = SURFACE_DEGREE;
    int k = 0;
    while (q >= 0) {
        // divide g by its largest coefficient, find its degree; in the first turn then f = g, and g its derivative
        real size = 0.0;
        for (int i = 0; i <= q; i++) size = max(size, fabs(g[i].hi));
        if (size > (k > 0 ? LEAST * UNIT_ROUNDOFF * UNIT_ROUNDOFF : real(0))) {
            for (int i = 0; i <= q; i++) g[i] = pair_scaled(g[i], 1.0 / size);
            while (q > 0 && !(fabs(g[q].hi) > LEAST * UNIT_ROUNDOFF)) q -= 1;
            for (int i = 0; i <= q; i++) chain[row_start(k) + i] = g[i].hi;
            for (int d = p; d >= q && k > 0; d--) {
                Pair factor = pair_negative(pair_quotient(f[d], g[q]));
                for (int i = 0; i < q; i++) f[d - q + i] = pair_sum(f[d - q + i], pair_product(factor, g[i]));
            }
            for (int i = 0; i <= q; i++) {
                Pair rest = k > 0 ? pair_negative(f[i]) : pair_scaled(g[min(i + 1, q)], real(i + 1) / real(SURFACE_DEGREE));
                f[i] = g[i];
                g[i] = rest;
            }
            p = q;
            q -= 1;
            k += 1;
        } else {
            q = -1;
        }
    }
}

// Computes the same chain to degree 4, one step in each turn of the loop, on rows whose highest power stands first. A
// compiler runs this code for all rays of a vector if one needs it; so a turn is short, and every index is known to it.
void careful_chain(IN real c[ROW], OUT real chain[CHAIN]) {
    Pair f[ROW];
    Pair g[ROW];
    for (int i = 0; i < CHAIN; i++) chain[i] = 0.0;
    for (int i = 0; i < ROW; i++) {
        f[i] = make_pair(0.0, 0.0);
        g[i] = make_pair(c[SURFACE_DEGREE - i], 0.0);
    }
    int p = -1;  // degrees of f and g
    int q = SURFACE_DEGREE;
    int k = 0;   // row of g in the chain
    bool fresh = true;
    while (q >= 0) {
        if (fresh) {
            real size = 0.0;
            for (int i = 0; i < ROW; i++) size = max(size, fabs(g[i].hi));
            if (!(size > (k > 0 ? LEAST * UNIT_ROUNDOFF * UNIT_ROUNDOFF : real(0)))) {
                q = -1;
            } else if (fabs(g[0].hi) > LEAST * UNIT_ROUNDOFF * size) {
                fresh = false;
                for (int i = 0; i < ROW; i++) g[i] = pair_scaled(g[i], 1.0 / size);
                // reverse the row, since the chain has the lowest power first
                real row[ROW];
                for (int i = 0; i < ROW; i++) row[i] = g[i].hi;
                for (int d = SURFACE_DEGREE; d > 0; d--) {
                    for (int i = SURFACE_DEGREE; i > 0; i--) row[i] = q < d ? row[i - 1] : row[i];
                    row[0] = q < d ? real(0) : row[0];
                }
                for (int r = 0; r < ROW; r++) {
                    for (int i = 0; i < ROW - r; i++) {
                        int at = row_start(r) + i;
                        chain[at] = k == r ? row[SURFACE_DEGREE - i] : chain[at];
                    }
                }
                if (k == 0) {
                    for (int i = 0; i < ROW; i++) {
                        f[i] = g[i];
                        g[i] = pair_scaled(g[i], real(max(q - i, 0)) / real(SURFACE_DEGREE));
                    }
                    p = q;
                    q -= 1;
                    fresh = true;
                }
                k += 1;
            } else {
                for (int i = 0; i < SURFACE_DEGREE; i++) g[i] = g[i + 1];
                g[SURFACE_DEGREE] = make_pair(0.0, 0.0);
                q -= 1;
            }
        } else if (p >= q) {
            Pair factor = pair_negative(pair_quotient(f[0], g[0]));
            for (int i = 0; i < SURFACE_DEGREE; i++) f[i] = pair_sum(f[i + 1], pair_product(factor, g[i + 1]));
            f[SURFACE_DEGREE] = make_pair(0.0, 0.0);
            p -= 1;
        } else {
            for (int i = 0; i < ROW; i++) {
                Pair rest = pair_negative(f[i]);
                f[i] = g[i];
                g[i] = rest;
            }
            int degree = p;
            p = q;
            q = degree;
            fresh = true;
        }
    }
}

real row_value(IN real chain[CHAIN], int k, real x) {
    int start = row_start(k);
    real value = chain[start + SURFACE_DEGREE - k];
    for (int i = SURFACE_DEGREE - k - 1; i >= 0; i--) value = value * x + chain[start + i];
    return value;
}

// Counts the changes of sign along the chain at x, without zeros, and says whether f itself is negative there. Where f
// is zero, it has the sign that f has just behind x by f'.
STRUCT(Count) struct Count { int changes; bool negative; };

Count sign_changes(IN real chain[CHAIN], real x) {
    Count count;
    count.changes = 0;
    real first = row_value(chain, 0, x);
    count.negative = first < 0.0;
    bool before = count.negative;
    for (int k = 1; k <= SURFACE_DEGREE; k++) {
        real value = row_value(chain, k, x);
        bool below = value == 0.0 ? before : value < 0.0;
        if (k == 1 && first == 0.0) before = below;
        count.changes += below != before ? 1 : 0;
        before = below;
    }
    return count;
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real c[ROW];
    Stretch stretch = surface_polynomial_along(ray, t0, t1, c);
    hit.evaluations = POLYNOMIAL_EVALUATIONS;
    real chain[CHAIN];
    if (SURFACE_DEGREE > 4) {
        scaled_chain(c, chain);
    } else {
        real reach = max(fabs(t0), fabs(t1));
        bool led = sturm_chain(c, reach, chain);
        if (CAREFUL == 1 && !led) {
            stretch.reach = reach;
            real power = 1.0;
            for (int i = 1; i <= SURFACE_DEGREE; i++) {
                power = power * reach;
                c[i] = c[i] * power;
            }
            real other[CHAIN];
            careful_chain(c, other);
            for (int i = 0; i < CHAIN; i++) chain[i] = other[i];
        }
    }
    PRECISE real size = 0.0;
    for (int i = 0; i < CHAIN; i++) size += fabs(chain[i]);
    if (!(size < REAL_INFINITY)) return exhausted(hit, t0);

    real a = (t0 - stretch.middle) / stretch.reach;
    real b = (t1 - stretch.middle) / stretch.reach;
    Count before = sign_changes(chain, a);
    Count after = sign_changes(chain, b);
    hit.evaluations += 2;
    if (before.changes < after.changes) return exhausted(hit, t0);
    bool without = before.changes == after.changes;
    if (DISCARD == 1 && without) return missed(hit);
    int i = 0;
    while (i < ITERATIONS
           && (BY_SIGN == 0 || before.changes - after.changes > 1 || before.negative == after.negative)) {
        real m = 0.5 * (a + b);
        Count middle = sign_changes(chain, m);
        if (middle.changes < before.changes) {
            b = m;
            after = middle;
        } else {
            a = m;
        }
        i += 1;
    }
    Along along = surface_along(ray);
    while (i < ITERATIONS) {
        real m = 0.5 * (a + b);
        real f = surface_value_along(along, stretch.middle + stretch.reach * m);
        if ((f < 0.0) == before.negative) { a = m; } else { b = m; }
        i += 1;
    }
    hit.evaluations += ITERATIONS;
    if (DISCARD == 0 && without) return missed(hit);
    return hit_at(hit, stretch.middle + stretch.reach * (0.5 * (a + b)));
}
