// Finds all roots of f in closed form, from f's Bernstein form, and answers the nearest (Loop and Blinn 2006). The
// variable is t or, where SCREEN is not 0, depth after the perspective division.

// Returns the t of a root s = u / (1 - u), or infinity where the root lies outside the ray's interval `stay`. `ratio`
// is that of the depths at the ends of `whole`, or 1 for distances. `reversed`: s is the root's reciprocal.
real root_along(real s, bool reversed, real ratio, Span whole, Span stay) {
    if (!(s > -0.5)) return REAL_INFINITY;
    real ahead = reversed ? ratio : s * ratio;
    real behind = reversed ? s : real(1);
    real t = whole.lo + (whole.hi - whole.lo) * (ahead / (ahead + behind));
    real slack = 16.0 * UNIT_ROUNDOFF * (whole.hi - whole.lo);
    return t >= stay.lo - slack && t <= stay.hi + slack ? t : REAL_INFINITY;
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real c[SURFACE_DEGREE + 1];
    surface_coefficients_along(ray, c);
    hit.evaluations = 1;

    Span stay = make_span(t0, t1);
    Span whole = make_span(t0 - WIDENING * (t1 - t0), t1 + WIDENING * (t1 - t0));
    real ratio = 1.0;
    real middle = inner_product(difference(DOMAIN_CENTER, ray.origin), ray.direction);  // t nearest the domain's centre
    real eye = middle - EYE * DOMAIN_RADIUS;
    if (SCREEN == 1) {
        whole = make_span(eye + NEAR * DOMAIN_RADIUS, eye + FAR * DOMAIN_RADIUS);
        ratio = NEAR / FAR;
    }
    if (SCREEN == 2) ratio = (whole.lo - eye) / (whole.hi - eye);
    // f as a polynomial in s, in three steps: expand about whole.lo, scale by its length, make homogeneous in (u, 1 -
    // u)
    real a[5];
    for (int i = 0; i < 5; i++) a[i] = 0.0;
    for (int i = 0; i <= SURFACE_DEGREE; i++) a[i] = c[i];
    for (int j = 0; j < SURFACE_DEGREE; j++) {
        for (int i = SURFACE_DEGREE - 1; i >= j; i--) a[i] += a[i + 1] * whole.lo;
    }
    real power = 1.0;
    for (int i = 1; i <= SURFACE_DEGREE; i++) {
        power = power * (whole.hi - whole.lo);
        a[i] = a[i] * power;
    }
    for (int j = 0; j < SURFACE_DEGREE; j++) {
        for (int i = SURFACE_DEGREE - 1; i >= j; i--) a[SURFACE_DEGREE - i] += a[SURFACE_DEGREE - i - 1];
    }
    if (EARLY_EXIT == 1) {
        bool above = true;
        bool below = true;
        for (int i = 0; i <= SURFACE_DEGREE; i++) {
            above = above && a[i] > 0.0;
            below = below && a[i] < 0.0;
        }
        if (above || below) return missed(hit);
    }
    power = 1.0;
    for (int i = 1; i <= SURFACE_DEGREE; i++) {
        power = power * ratio;
        a[i] = a[i] * power;
    }

    bool reversed = fabs(a[0]) > fabs(a[SURFACE_DEGREE]);
    for (int i = 0; 2 * i < SURFACE_DEGREE; i++) {
        real low = a[i];
        a[i] = reversed ? a[SURFACE_DEGREE - i] : low;
        a[SURFACE_DEGREE - i] = reversed ? low : a[SURFACE_DEGREE - i];
    }
    real scale = 1.0 / a[SURFACE_DEGREE];
    PRECISE real size = 0.0;
    for (int i = 0; i < SURFACE_DEGREE; i++) {
        a[i] = a[i] * scale;
        size += fabs(a[i]);
    }
    if (!(size < REAL_INFINITY)) return exhausted(hit, t0);

    Roots roots = no_roots();
    real shift = 0.0;
    if (SURFACE_DEGREE == 1) roots.a = -a[0];
    if (SURFACE_DEGREE == 2) roots = quadratic_roots(0.5 * a[1], a[0]);
    if (SURFACE_DEGREE == 3) roots = cubic_roots(a[2], a[1], a[0]);
    if (SURFACE_DEGREE == 4) {
        shift = 0.25 * a[3];
        real square = shift * shift;
        roots = depressed_quartic_roots(a[2] - 6.0 * square,
                                        a[1] - 2.0 * shift * (a[2] - 4.0 * square),
                                        a[0] - shift * (a[1] - shift * (a[2] - 3.0 * square)));
    }
    real t = min(min(root_along(roots.a - shift, reversed, ratio, whole, stay),
                     root_along(roots.b - shift, reversed, ratio, whole, stay)),
                 min(root_along(roots.c - shift, reversed, ratio, whole, stay),
                     root_along(roots.d - shift, reversed, ratio, whole, stay)));
    if (!(t < REAL_INFINITY)) return missed(hit);

    for (int k = 0; k < POLISH; k++) {
        real f = c[SURFACE_DEGREE];
        real slope = 0.0;
        for (int i = SURFACE_DEGREE - 1; i >= 0; i--) {
            slope = slope * t + f;
            f = f * t + c[i];
        }
        real step = f / slope;
        if (fabs(step) < 0.0078125 * (t1 - t0)) t -= step;
    }
    hit.evaluations += POLISH;
    return hit_at(hit, clamp(t, t0, t1));
}
