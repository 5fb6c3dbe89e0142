// Finds the first t in [t0, t1] where f changes its sign along the ray, and counts the evaluations of f.
// This text is compiled as GLSL and as OpenCL C, with real = float and real = double.
Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);                      // a miss, until a hit is found
    Along along = surface_along(ray);          // f along this ray, ready to be evaluated at any t
    real step = (t1 - t0) / real(STEPS);
    real before = surface_value_along(along, t0);
    hit.evaluations = 1;
    for (int i = 1; i <= STEPS; i++) {
        real t = t0 + step * real(i);
        real value = surface_value_along(along, t);
        hit.evaluations += 1;
        if ((before < 0.0) != (value < 0.0)) {
            return hit_at(hit, t - step * (value / (value - before)));    // where the secant through both is 0
        }
        before = value;
    }
    return hit;
}
