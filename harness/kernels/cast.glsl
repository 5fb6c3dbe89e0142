// The harness's part of every ray: move its origin as own_ray does, clip, call the method.
STRUCT(Cast) struct Cast { real shift; Hit hit; };

// The first hit with lower <= t <= upper.
Cast cast_ray_between(Ray ray, real lower, real upper) {
    Cast result;
    OwnRay own = own_ray(ray);
    result.shift = own.shift;
    real t0 = max(own.span.lo, lower - own.shift);
    real t1 = min(own.span.hi, upper - own.shift);
    if (t0 <= t1) {
        result.hit = first_hit(own.ray, t0, t1);
    } else {
        result.hit = no_hit(t0);
    }
    return result;
}

Cast cast_ray(Ray ray) {
    return cast_ray_between(ray, 0.0, REAL_INFINITY);
}

// Evaluations and status in one word; NO_ANSWER where they are none.
int packed_answer(Hit hit) {
    return is_answer(hit.status, hit.evaluations) ? hit.evaluations * 4 + hit.status : NO_ANSWER;
}
