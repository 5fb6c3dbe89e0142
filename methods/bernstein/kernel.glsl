// Finds the first root of f along the ray: fits f in Bernstein form and halves it from the near end on. The sign of a
// coefficient counts only if its magnitude exceeds its error bound. The factor `sign` makes f positive at the near end.
#define N SURFACE_DEGREE
#define SHELLS 16  // sizes of the tables VALUE_ERRORS and GROWTH
#define DEPTHS 6
#define FINEST 4.0  // least tolerance, in unit roundoffs
#define SHORT 0.0625  // longest last step, over the root of the tolerance

// The least coefficient of a piece, and the largest of those behind the first coefficient that is not certainly
// positive.
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

// Halves a piece by de Casteljau's algorithm. `far` holds the piece's coefficients, and then those of its far half;
// `near` receives those of its near half.
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

// Estimates where b has its least minimum inside (0, 1): there the control polygon of its derivative rises through
// zero. Returns 0.5 where it does so nowhere.
real lowest_place(IN real b[COEFFICIENTS]) {
    real place = 0.5;
    real lowest = REAL_INFINITY;
    for (int j = 1; j < N; j++) {
        real before = b[j] - b[j - 1];
        real behind = b[j + 1] - b[j];
        if (before < 0.0 && behind >= 0.0 && b[j] < lowest) {
            lowest = b[j];
            place = (real(j - 1) + before / (before - behind)) / real(N - 1);
        }
    }
    return place;
}

// Error bounds of a piece: `off` of a sample, `noise` of the fit's own rounding, `unit` of one halving's rounding per
// degree. `most` is 1 where coefficients within their bound may be part of a change of sign, and -1 where not.
STRUCT(Errors) struct Errors { real off; real noise; real unit; real most; };

real error_at(Errors errors, int depth) {
    return GROWTH[min(depth, DEPTHS)] * errors.off + errors.noise + real(N * (depth + 1)) * errors.unit;
}

// A piece of the fitted interval, one of `pieces` pieces of the same length. The binary digits of `path` after its
// first lead to it from the whole: 0 for a near half, 1 for a far half. `empty`: no root. `single`: one root.
STRUCT(Piece) struct Piece { int path; int pieces; bool empty; bool single; };

Piece judged(Piece piece, IN real c[COEFFICIENTS], real error, real most) {
    Piece result = piece;
    Signs signs = signs_of(c, error);
    result.empty = signs.least > error;
    result.single = c[N] < -error && signs.after < most * error;
    return result;
}

// Halves the piece again and again, and keeps the first half that may hold a root, until it is empty or has one root.
Piece descended(Piece start, INOUT real c[COEFFICIENTS], Errors errors) {
    real far[COEFFICIENTS];
    Piece piece = start;
    for (int depth = 1; depth <= TRUSTED && !piece.empty && !piece.single; depth++) {
        real error = error_at(errors, depth);
        for (int j = 0; j <= N; j++) far[j] = c[j];
        halve(far, c);
        piece.path = 2 * piece.path;
        piece.pieces = 2 * piece.pieces;
        real least = c[0];
        for (int j = 1; j <= N; j++) least = min(least, c[j]);
        bool beyond = least > error;
        piece.path += beyond ? 1 : 0;
        for (int j = 0; j <= N; j++) c[j] = beyond ? far[j] : c[j];
        piece = judged(piece, c, error, errors.most);
    }
    return piece;
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real shortest = 64.0 * UNIT_ROUNDOFF * max(fabs(t0), fabs(t1));
    vec3 from_center = difference(ray.origin, DOMAIN_CENTER);  // its square at t: near + (drift + t) t
    real near = inner_product(from_center, from_center);
    real drift = 2.0 * inner_product(from_center, ray.direction);
    real s[COEFFICIENTS];
    real b[COEFFICIENTS];
    real c[COEFFICIENTS];
    real sign = 1.0;
    real start = t0;  // the fitted interval is [start, end]; there is no root before `start`
    real end = t1;
    real base = t0;   // c is f on t = base + size u, u in [0, 1]; in the end f is positive at u = a
    real size = 0.0;  // and negative at u = z, if there is a hit
    real a = 0.0;
    real z = 1.0;
    real fz = 0.0;
    bool again = false;  // whether an open piece is being fitted anew
    while (start < t1) {
        real reach = end - start;
        for (int i = 0; i <= N; i++) s[i] = surface_value(ray_point(ray, start + reach * NODES[i]));
        hit.evaluations += N + 1;
        if (hit.evaluations == N + 1) sign = s[0] < 0.0 ? real(-1) : real(1);
        for (int i = 0; i <= N; i++) s[i] = sign * s[i];
        fit(s, true, N >= COMPENSATED, b);
        for (int j = 0; j <= N; j++) c[j] = b[j];

        // error bounds: of a sample (off), of a halving (unit), of the fit (noise)
        real away = sqrt(max(near + max((drift + start) * start, (drift + end) * end), real(0)));
        real off = TRUST * UNIT_ROUNDOFF * VALUE_ERRORS[min(int(away * (real(SHELLS) / DOMAIN_RADIUS)), SHELLS - 1)];
        real unit = TRUST * UNIT_ROUNDOFF * largest(b);
        real weighted = 0.0;
        for (int i = 0; i <= N; i++) weighted += COLUMNS[i] * fabs(s[i]);
        real noise = 2.0 * TRUST * UNIT_ROUNDOFF * (N >= COMPENSATED ? 2.0 * largest(b) : real(N / 2 + 6) * weighted);

        real above = 0.0;  // node of the sample before the first negative one
        real under = 1.0;
        real f_under = 0.0;
        for (int i = N; i > 0; i--) {
            if (s[i] < 0.0) {
                above = NODES[i - 1];
                under = NODES[i];
                f_under = s[i];
            }
        }

        Errors errors;
        errors.off = off;
        errors.noise = noise;
        errors.unit = unit;
        errors.most = again ? real(1) : real(-1);
        Piece piece;
        piece.path = 1;
        piece.pieces = 1;
        piece = judged(piece, c, error_at(errors, 0), errors.most);
        // if coefficients and samples change sign equally often, each root lies between two samples
        real certain = error_at(errors, 0);
        int more = N <= COUNTED ? 0 : 1;
        if (N <= COUNTED) {
            for (int i = 1; i <= N; i++) {
                more += (b[i] < 0.0) != (b[i - 1] < 0.0) ? 1 : 0;
                more -= (s[i] < 0.0) != (s[i - 1] < 0.0) ? 1 : 0;
                certain = min(certain, fabs(b[i]));
            }
        }
        bool counted = more == 0 && certain == error_at(errors, 0);
        // a piece that is all noise is decided by f itself, at the samples and at the fit's minimum
        bool settled = unit <= NOISE * TRUST * UNIT_ROUNDOFF * (GROWTH[DEPTHS] * off + noise);
        settled = settled || reach <= shortest || hit.evaluations > FITS * (N + 1);
        if (settled && !counted && f_under >= 0.0) {
            real u = lowest_place(b);
            real f = sign * surface_value(ray_point(ray, start + reach * u));
            hit.evaluations += 1;
            if (f < 0.0) {
                above = 0.0;
                under = u;
                f_under = f;
            }
        }
        settled = settled || counted;
        if (s[0] >= 0.0 && !settled) piece = descended(piece, c, errors);
        bool empty = piece.empty;
        bool single = piece.single && !settled;
        real width = reach / real(piece.pieces);
        real x = start + width * real(piece.path - piece.pieces);
        bool before = s[0] < 0.0;  // a root lies in front of `start`
        again = !before && !single && !empty && !settled;
        if (single && !before) {
            base = x;
            size = width;
            fz = min(sign * surface_value(ray_point(ray, x + width)), real(0));
            hit.evaluations += 1;
            again = fz >= 0.0;
        }
        bool last = settled || piece.path + 1 == 2 * piece.pieces;
        real behind = last ? end : x + width;
        if (before || (last && !again && fz >= 0.0 && f_under < 0.0)) {
            for (int j = 0; j <= N; j++) c[j] = b[j];
            base = start;
            size = reach;
            a = before ? -1.0 / WIDENING : above;
            z = before ? real(0) : under;
            fz = before ? s[0] : f_under;
        }
        start = again ? x : behind;
        end = again ? behind : min(behind + WIDENING * width, t1);
        if (fz < 0.0 || hit.evaluations >= MAX_EVALUATIONS) start = t1;
    }
    if (fz >= 0.0 && hit.evaluations >= MAX_EVALUATIONS) return exhausted(hit, base);
    if (fz >= 0.0) return hit;

    // Newton's method, kept within the bracket, with f's own value and the fit's slope. A step s leaves an error of
    // about f''/(2 f') s^2, and up to four times that next to a double root; f'' is the change of the slope over the step
    // before. As that says nothing where f'' passes through zero, the last step is short too.
    for (int j = 0; j <= N; j++) c[j] = BINOMIALS[j] * c[j];
    real fa = sign * surface_value(ray_point(ray, base + size * a));
    hit.evaluations += 1;
    real whole = (t1 - t0) / size;  // the ray's length, in which tolerances are stated
    real tolerance = max(TOLERANCE, FINEST * UNIT_ROUNDOFF) * whole;
    real longest = SHORT * sqrt(tolerance * whole);
    Bracket bracket = make_bracket(a, z, max(fa, real(0)), fz);
    Dual f = make_dual(fz, (fz - max(fa, real(0))) / (z - a));
    real left = bracket.step;
    for (int i = 0; i < MOST_STEPS && (left > tolerance || bracket.step > longest); i++) {
        real before = bracket.step;
        real slope = f.derivative;
        f = polynomial_dual(c, N, true, bracket.x);
        f.value = sign * surface_value(ray_point(ray, base + size * bracket.x));
        hit.evaluations += 1;
        bracket = newton_step(bracket, f, false);
        bool halved = f.derivative >= 0.0 || fabs(f.value) >= -1.5 * f.derivative * bracket.step;
        real bend = fabs(1.0 - slope / f.derivative) / before;
        left = halved ? bracket.step : 2.0 * bend * bracket.step * bracket.step;
    }
    // one last Newton step with the mean of f over points around t, in which rounding errors cancel
    real t = base + size * bracket.x;
    real sum = 0.0;
    for (int k = 1; k <= PAIRS; k++) {
        real away = real(k) * (APART * UNIT_ROUNDOFF * (t1 - t0));
        sum += surface_value(ray_point(ray, t - away)) + surface_value(ray_point(ray, t + away));
    }
    hit.evaluations += 2 * PAIRS;
    if (PAIRS > 0 && f.derivative < 0.0) t -= size * (sign * sum / (real(2 * PAIRS) * f.derivative));
    return hit_at(hit, clamp(t, base + size * bracket.a, base + size * bracket.b));
}
