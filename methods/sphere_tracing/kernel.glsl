// Takes steps as long as the distance to the surface, until that distance is nearly 0 (toledo2007, section 4.3). With
// RAYS 2 the march jumps to t_M as soon as the distance grows. With AHEAD 1 it never jumps back, and the second march
// ends where the distance grows after it fell. Both are for distances with two minima along a line at most, about
// the origin; STARTS is 1 for all others.
Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real near_enough = EPSILON * FEATURE_RADIUS;
    real t_m = -inner_product(ray.origin, ray.direction);
    bool two = RAYS == 2 && STARTS[0] == 2.0;
    real t = t0;
    real distance_here = 0.0;
    bool second = false;
    bool searching = true;
    if (two) {
        real before = REAL_INFINITY;
        bool fell = true;
        while (searching) {
            distance_here = surface_distance(ray_point(ray, t));
            hit.evaluations += 1;
            bool grows = distance_here > before;
            bool turned = grows && fell && (AHEAD == 1 || !second);
            fell = !grows;
            before = distance_here;
            real next = t + distance_here;
            if (turned) {
                fell = false;
                before = next < t_m ? -REAL_INFINITY : before;
                next = AHEAD == 1 ? max(next, t_m) : max(t0, t_m);
            }
            searching = !(distance_here < near_enough || next > t1 || (turned && second)
                          || hit.evaluations == MAX_EVALUATIONS);
            second = second || turned;
            if (searching) t = next;
        }
    }
    // with one start, or when inside the surface: go back from the second start, or on from the first
    real way = second ? -1.0 : 1.0;
    if (two) {
        if (searching) return exhausted(hit, t);
        searching = distance_here <= -near_enough;
        t += searching ? way * fabs(distance_here) : real(0);
    }
    while (searching) {
        distance_here = fabs(surface_distance(ray_point(ray, t)));
        hit.evaluations += 1;
        real next = t + way * distance_here;
        searching = !(distance_here < near_enough || next > t1 || hit.evaluations >= MAX_EVALUATIONS);
        if (searching) t = next;
    }
    if (fabs(distance_here) < near_enough) return hit_at(hit, t);
    if (searching || hit.evaluations >= MAX_EVALUATIONS) return exhausted(hit, t);
    return hit;
}
