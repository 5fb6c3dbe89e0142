// Searches pieces of [t0, t1] by derivative bisection (toledo2007, section 4.2), the nearest piece first.

// Returns a root in [a, b] as a hit, else `hit` itself, with the evaluations added. The root is the first one in [a, b]
// if f changes sign once there, or has one extreme that points towards 0.
Hit derivative_bisection(Hit hit, Along along, real a, real b) {
    Dual fa = surface_dual_along(along, a);
    Dual fb = surface_dual_along(along, b);
    hit.evaluations += 2;
    real side = fa.value < 0.0 ? -1.0 : 1.0;
    bool crossed = side * fb.value <= 0.0;
    // with SPLIT 1 the slopes at a piece's ends tell whether f turns in it; with a split at t_M they tell nothing
    bool turns = SPLIT == 1 ? side * fa.derivative < 0.0 && side * fb.derivative > 0.0 : a < b;
    if (!(a <= b) || !(crossed || turns)) return hit;
    for (int i = 0; i < ITERATIONS; i++) {
        real m = 0.5 * (a + b);
        Dual f = surface_dual_along(along, m);
        if (side * f.value <= 0.0) {
            b = m;
            crossed = true;
        } else if (crossed || side * f.derivative < 0.0) {
            a = m;
        } else {
            b = m;
        }
    }
    hit.evaluations += ITERATIONS;
    return crossed ? hit_at(hit, 0.5 * (a + b)) : hit;
}

Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    Along along = surface_along(ray);
    real t_m = -along.c[3] / (4.0 * along.c[4]);
    // f'' = 12 a (t - t_m)^2 + curvature
    real curvature = 2.0 * along.c[2] - 12.0 * along.c[4] * t_m * t_m;
    real half_width = SPLIT == 1 ? sqrt(max(-curvature / (12.0 * along.c[4]), real(0))) : real(0);
    real first = clamp(t_m - half_width, t0, t1);
    real second = clamp(t_m + half_width, t0, t1);

    hit = derivative_bisection(hit, along, t0, first);
    if (SPLIT == 1 && hit.status == MISS) hit = derivative_bisection(hit, along, first, second);
    if (hit.status == MISS) hit = derivative_bisection(hit, along, second, t1);
    return hit;
}
