// The first root of f along the ray: the fit's Bernstein form, halved from the near end on, where signs of coefficients
// count only outside their error bounds. f is taken as positive at the near end: `sign` makes it so.
#define N SURFACE_DEGREE
#define SHELLS 16  // sizes of the tables VALUE_ERRORS and GROWTH
#define DEPTHS 6

// Of a piece's coefficients: the least, and the largest of those after the first that is not certainly positive.
STRUCT(Signs) struct Signs { real least; real after; };

Signs signs_of(IN real c[COEFFICIENTS], real error) {
    Signs signs;
    signs.least = c[0];
    signs.after = -REAL_INFINITY;
    for (int j = 1; j <= N; j++) {
        signs.after = signs.least <= error ? max(signs.after, c[j]) : signs.after;
        signs.least = min(signs.least, c[j]);
    }
    return signs;
}

real largest(IN real c[COEFFICIENTS]) {
    real size = fabs(c[0]);
    for (int j = 1; j <= N; j++) size = max(size, fabs(c[j]));
    return size;
}

// De Casteljau's algorithm in the middle: `near` gets the near half's coefficients, `far` what it was and the far half's.
void halve(INOUT real far[COEFFICIENTS], OUT real near[COEFFICIENTS]) {
    real share = 1.0;
    near[0] = far[0];
    for (int r = 1; r <= N; r++) {
        share = 0.5 * share;
        for (int j = 0; j <= N - r; j++) far[j] = far[j] + far[j + 1];
        near[r] = share * far[0];
    }
    for (int j = 0; j < N; j++) {
        far[j] = share * far[j];
        share = 2.0 * share;
    }
}

// De Casteljau's algorithm: `near` gets the coefficients on the first `share` of the interval, `far` keeps the rest's.
void divide(real share, INOUT real far[COEFFICIENTS], OUT real near[COEFFICIENTS]) {
    near[0] = far[0];
    for (int r = 1; r <= N; r++) {
        for (int j = 0; j <= N - r; j++) far[j] = far[j] + share * (far[j + 1] - far[j]);
        near[r] = far[0];
    }
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real smallest = RESOLUTION * (t1 - t0);
    real s[COEFFICIENTS];
    real b[COEFFICIENTS];
    real c[COEFFICIENTS];
    real far[COEFFICIENTS];
    real sign = 1.0;
    real start = t0;  // [start, end]: what is fitted; before `start` there is no root
    real end = t1;
    real a = t0;      // f is positive there
    real z = t0;      // and negative here, where the search ends by a hit
    real fz = 0.0;
    bool again = false;  // the piece was open before, and is fitted anew
    while (start < t1) {
        real reach = end - start;
        for (int i = 0; i <= N; i++) s[i] = surface_value(ray_point(ray, start + reach * NODES[i]));
        hit.evaluations += N + 1;
        if (hit.evaluations == N + 1) sign = s[0] < 0.0 ? real(-1) : real(1);
        for (int i = 0; i <= N; i++) s[i] = sign * s[i];
        fit(s, true, EFT == 1, b);
        for (int j = 0; j <= N; j++) c[j] = b[j];

        // what a sample may be off by, and the fit's and the halvings' own roundings
        vec3 p = difference(ray_point(ray, start), DOMAIN_CENTER);
        vec3 q = difference(ray_point(ray, end), DOMAIN_CENTER);
        real away = sqrt(max(inner_product(p, p), inner_product(q, q))) / DOMAIN_RADIUS;
        real off = TRUST * UNIT_ROUNDOFF * VALUE_ERRORS[min(int(away * real(SHELLS)), SHELLS - 1)];
        real unit = TRUST * UNIT_ROUNDOFF * largest(b);
        real noise = EFT == 1 ? 2.0 * unit : real(N / 2 + 6) * TRUST * UNIT_ROUNDOFF * GROWTH[0] * largest(s);

        real under = end;  // the first sample that is negative, and the one before it
        real f_under = 0.0;
        real above = start;
        for (int i = N; i > 0; i--) {
            if (s[i] < 0.0) {
                under = start + reach * NODES[i];
                f_under = s[i];
                above = start + reach * NODES[i - 1];
            }
        }

        int path = 1;
        int pieces = 1;
        int depth = 0;
        real error = GROWTH[0] * off + noise;
        Signs signs = signs_of(c, error);
        bool empty = signs.least > error;
        real most = again ? error : -error;
        bool single = c[N] < -error && signs.after < most;
        // what is all noise is decided by f itself, at the samples
        bool noisy = reach <= smallest || unit <= NOISE * TRUST * UNIT_ROUNDOFF * (GROWTH[DEPTHS] * off + noise);
        bool walking = s[0] >= 0.0 && !noisy && !empty && !single;
        while (walking) {
            if (empty) {
                path += 1;
                int up = path & (-path);
                path = path / up;
                pieces = pieces / up;
                depth = 0;
                for (int d = 1; d <= DEPTHS; d++) depth += (pieces >> d) > 0 ? 1 : 0;
                real part = 1.0 / real(pieces);
                real x = part * real(path - pieces);
                for (int j = 0; j <= N; j++) far[j] = b[j];
                divide(x, far, c);
                divide(part / (1.0 - x), far, c);
            } else {
                for (int j = 0; j <= N; j++) far[j] = c[j];
                halve(far, c);
                path = 2 * path;
                pieces = 2 * pieces;
                depth = depth + 1;
            }
            error = GROWTH[min(depth, DEPTHS)] * off + noise + real(N * (depth + 1)) * unit;
            signs = signs_of(c, error);
            empty = signs.least > error;
            if (empty && (path & 1) == 0) {
                path += 1;
                for (int j = 0; j <= N; j++) c[j] = far[j];
                signs = signs_of(c, error);
                empty = signs.least > error;
            }
            most = again ? error : -error;
            single = c[N] < -error && signs.after < most;
            // all ones: the last piece
            walking = !single && (empty ? path + 1 < 2 * pieces : depth < TRUSTED);
        }
        real width = reach / real(pieces);
        real x = start + width * real(path - pieces);
        again = false;
        if (s[0] < 0.0) {
            z = start;
            fz = s[0];
        } else if (single) {
            real f = sign * surface_value(ray_point(ray, x + width));
            hit.evaluations += 1;
            if (f < 0.0) {
                a = x;
                z = x + width;
                fz = f;
            } else {
                again = true;
            }
        } else {
            again = !empty && !noisy;
        }
        if (!again && fz >= 0.0 && f_under < 0.0) {
            a = above;
            z = under;
            fz = f_under;
        }
        if (fz >= 0.0) a = again ? x : end;
        start = again ? x : end;
        end = again ? x + width : min(end + WIDENING * reach, t1);
        if (fz < 0.0 || hit.evaluations >= MAX_EVALUATIONS) start = t1;
    }
    if (fz >= 0.0 && hit.evaluations >= MAX_EVALUATIONS) return exhausted(hit, a);
    if (fz >= 0.0) return hit;

    real fa = sign * surface_value(ray_point(ray, a));
    hit.evaluations += 1;

    // ITP (Oliveira, Takahashi 2020): regula falsi, drawn towards the middle and kept within bisection's worst case
    real tolerance = TOLERANCE * (t1 - t0);
    real spread = 2.0 * tolerance;  // at least z - a, doubled
    while (spread < 2.0 * (z - a)) spread = 2.0 * spread;
    real pull = 0.1875 / (z - a);
    for (int i = 0; i < MOST_STEPS && z - a > tolerance; i++) {
        real middle = 0.5 * (a + z);
        real x = z - fz * ((z - a) / (fz - fa));
        real delta = pull * (z - a) * (z - a);
        real towards = middle < x ? real(-1) : real(1);
        x = fabs(middle - x) > delta ? x + towards * delta : middle;
        real radius = 0.5 * (spread - (z - a));
        if (fabs(middle - x) > radius) x = middle - towards * radius;
        real f = sign * surface_value(ray_point(ray, x));
        hit.evaluations += 1;
        if (f > 0.0) {
            a = x;
            fa = f;
        } else {
            z = x;
            fz = f;
        }
        spread = 0.5 * spread;
    }
    return hit_at(hit, fa > fz ? z - fz * ((z - a) / (fz - fa)) : z);
}
