// Takes steps of |f| over a bound of |grad f| in the ball that ends with the next shell, until a secant step is short
// enough or f changes sign (Hart 1996).
Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    vec3 o = difference(ray.origin, DOMAIN_CENTER);
    real origin_away = inner_product(o, o);
    real advance = 2.0 * inner_product(o, ray.direction);
    // From a far origin the terms of `away` cancel. A bound of their rounding error is added, so that `away` stays
    // above 0 and `shell` within the table.
    origin_away += 16.0 * UNIT_ROUNDOFF * advance * advance;
    real thickness = DOMAIN_RADIUS / real(SHELLS);
    real squared_thickness = thickness * thickness;
    real least = EPSILON * DOMAIN_RADIUS;
    int shell = 0;
    for (int k = 1; k < SHELLS; k++) {
        if (origin_away + t0 * (advance + t0) > real(k * k) * squared_thickness) shell = k;
    }

    Along along = surface_along(ray);
    real t = t0;
    real step = 0.0;
    real before = 0.0;
    while (t <= t1) {
        if (hit.evaluations == MAX_EVALUATIONS) return exhausted(hit, t);
        real f = surface_value_along(along, t);
        hit.evaluations += 1;
        if (f == 0.0) return hit_at(hit, t);
        if (hit.evaluations > 1) {
            real to_root = step * (f / (before - f));
            if ((f < 0.0) != (before < 0.0) || (to_root > 0.0 && to_root < least)) return hit_at(hit, t + to_root);
        }
        before = f;
        // no step is longer than a shell is thick, so `shell` changes by at most one
        if (SHELLS > 1) {
            real away = origin_away + t * (advance + t);
            if (away < real(shell * shell) * squared_thickness) shell -= 1;
            if (away > real((shell + 1) * (shell + 1)) * squared_thickness) shell = min(shell + 1, SHELLS - 1);
        }
        step = max(min(fabs(f) * REACH[shell], thickness), least);
        t += step;
    }
    return t <= t1 ? exhausted(hit, t) : hit;
}
