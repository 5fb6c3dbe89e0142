// Takes Newton steps on f along the ray, none longer than λ, from the near side of the bounding sphere (toledo2007,
// section 4.4).
Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real t = t0;
    real end = t1;
    if (SPHERE_START == 1) {
        vec3 o = difference(ray.origin, DOMAIN_CENTER);
        real middle = -inner_product(o, ray.direction);
        vec3 nearest = moved(o, middle, ray.direction);
        real squared_half = BOUNDING_RADIUS * BOUNDING_RADIUS - inner_product(nearest, nearest);
        if (squared_half < 0.0) return hit;
        real half_length = sqrt(squared_half);
        t = max(t0, middle - half_length);
        end = min(t1, middle + half_length);
    }

    real longest = STEP_BOUND * BOUNDING_RADIUS;
    real last = EPSILON * FEATURE_RADIUS;
    Along along = surface_along(ray);
    Dual f = surface_dual_along(along, t);
    hit.evaluations = 1;
    bool outside_is_negative = f.value < 0.0;
    while (true) {
        real step = f.derivative == 0.0 ? longest : clamp(-f.value / f.derivative, -longest, longest);
        if (FORWARD == 1) step = (f.value < 0.0) == outside_is_negative ? fabs(step) : -fabs(step);
        t += step;
        if (t > end) return missed(hit);
        if (fabs(step) < last) {
            if (FORWARD == 1) return hit_at(hit, t);
            // signed steps may end in front of the ray's start
            return t < t0 - last ? exhausted(hit, t0) : hit_at(hit, max(t, t0));
        }
        if (hit.evaluations == MAX_EVALUATIONS) return exhausted(hit, t);
        f = surface_dual_along(along, t);
        hit.evaluations += 1;
    }
    return exhausted(hit, t);
}
