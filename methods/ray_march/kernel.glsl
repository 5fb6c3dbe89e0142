// Equidistant steps until f changes sign, then bisection of that step (szente's baseline).
Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    Along along = surface_along(ray);
    real step = 2.0 * DOMAIN_RADIUS / real(STEPS);
    real a = t0;
    real b = t0;
    real fa = surface_value_along(along, t0);
    real fb = fa;
    hit.evaluations = 1;
    while (fb != 0.0 && (fa < 0.0) == (fb < 0.0)) {
        if (b >= t1) return hit;
        a = b;
        fa = fb;
        b = min(t0 + step * real(hit.evaluations), t1);
        fb = surface_value_along(along, b);
        hit.evaluations += 1;
    }
    if (fb == 0.0) return hit_at(hit, b);

    for (int i = 0; i < REFINEMENTS; i++) {
        real m = 0.5 * (a + b);
        real fm = surface_value_along(along, m);
        if ((fa < 0.0) == (fm < 0.0)) { a = m; fa = fm; } else { b = m; fb = fm; }
    }
    hit.evaluations += REFINEMENTS;
    return hit_at(hit, a + (b - a) * (fa / (fa - fb)));
}
