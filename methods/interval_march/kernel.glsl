// Finds the first piece [t, t + width] in [t0, t1] over which f's interval extension contains 0 and that is short
// enough, by bisection, nearest half first (beamcasting, section III).
Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real smallest = TOLERANCE * DOMAIN_RADIUS;
    real t = t0;
    real width = t1 - t0;
    while (t < t1) {
        if (hit.evaluations == MAX_EVALUATIONS) return exhausted(hit, t);
        real end = min(t + width, t1);
        Interval range = surface_range_along(ray, t, end);
        hit.evaluations += 1;
        if (range.lo > 0.0 || range.hi < 0.0) {
            t = end;
            width = 2.0 * width;
        } else if (width > smallest) {
            width = 0.5 * width;
        } else {
            return hit_at(hit, t + 0.5 * (end - t));
        }
    }
    return t < t1 ? exhausted(hit, t) : hit;
}
