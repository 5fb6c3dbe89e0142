// f as it is marched: its expansion along the ray, or f itself at the ray's point.
real marched_value(Ray ray, Along along, real t) {
    return EXPAND == 1 ? surface_value_along(along, t) : surface_value(ray_point(ray, t));
}

// Takes equidistant steps until f changes sign, then halves that step (szente's baseline).
Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    Along along = surface_along(ray);
    real step = 2.0 * DOMAIN_RADIUS / real(STEPS);
    real a = t0;
    real b = t0;
    real fa = marched_value(ray, along, t0);
    real fb = fa;
    bool below = fa < 0.0;
    hit.evaluations = 1;
    // pass whole blocks without a change of sign; the evaluations of a block do not wait for each other
    int k = 0;
    bool same = fa != 0.0;
    while (BLOCK > 1 && same && t0 + step * real(k + BLOCK) < t1) {
        real last = 0.0;
        for (int i = 1; i <= BLOCK; i++) {
            last = marched_value(ray, along, t0 + step * real(k + i));
            same = same && last != 0.0 && (last < 0.0) == below;
        }
        hit.evaluations += BLOCK;
        if (same) {
            k += BLOCK;
            fb = last;
        }
    }
    b = t0 + step * real(k);
    while (fb != 0.0 && below == (fb < 0.0)) {
        if (b >= t1) return hit;
        a = b;
        fa = fb;
        k += 1;
        b = min(t0 + step * real(k), t1);
        fb = marched_value(ray, along, b);
        hit.evaluations += 1;
    }
    if (fb == 0.0) return hit_at(hit, b);
    if (below == (fb < 0.0)) return exhausted(hit, b);

    for (int i = 0; i < REFINEMENTS; i++) {
        real m = 0.5 * (a + b);
        real fm = marched_value(ray, along, m);
        if (below == (fm < 0.0)) { a = m; fa = fm; } else { b = m; fb = fm; }
    }
    hit.evaluations += REFINEMENTS;
    return hit_at(hit, SECANT == 1 ? a + (b - a) * (fa / (fa - fb)) : b);
}
