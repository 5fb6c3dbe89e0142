// Steps as long as the distance to the surface, until it is nearly 0 (toledo2007, 4.3). With RAYS 2 the march jumps to
// t_M as soon as the distance grows, and ends where it has fallen again and grows again.
#define FIRST_MARCH 1
#define SECOND_MARCH 2
#define ONLY_MARCH 3

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real near_enough = EPSILON * FEATURE_RADIUS;
    real t_m = inner_product(difference(DOMAIN_CENTER, ray.origin), ray.direction);
    real t = t0;
    real way = 1.0;
    real before = REAL_INFINITY;
    bool fell = false;
    int march = RAYS == 2 ? FIRST_MARCH : ONLY_MARCH;
    while (t <= t1) {
        if (hit.evaluations == MAX_EVALUATIONS) return exhausted(hit, t);
        real distance_here = surface_distance(ray_point(ray, t));
        hit.evaluations += 1;
        if (fabs(distance_here) < near_enough) return hit_at(hit, t);

        bool grows = distance_here > before;
        if (march == SECOND_MARCH && fell && grows) return missed(hit);
        fell = before < REAL_INFINITY && !grows;
        before = distance_here;
        if (march != ONLY_MARCH && distance_here < 0.0) {
            way = march == SECOND_MARCH ? -1.0 : 1.0;
            march = ONLY_MARCH;
        }
        t += way * fabs(distance_here);
        if (march == FIRST_MARCH && grows) {
            march = SECOND_MARCH;
            fell = false;
            if (t < t_m) {
                t = t_m;
                before = REAL_INFINITY;
            }
        }
    }
    return hit;
}
