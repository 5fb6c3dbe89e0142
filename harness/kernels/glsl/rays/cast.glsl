// What the harness does with every ray: it moves the origin by own_shift, clips the ray, and calls the method. The
// hit's t is along the moved ray; along the ray as given it is shift + hit.t.
STRUCT(Cast) struct Cast { real shift; Hit hit; };

// Returns the first hit with lower <= t <= upper, t along the ray as given.
Cast cast_ray_between(Ray ray, real lower, real upper) {
    Cast result;
    result.shift = own_shift(ray);
    Ray own = advanced_ray(ray, result.shift);
    Span span = own_span(ray, own, result.shift);
    real t0 = max(span.lo, lower - result.shift);
    real t1 = min(span.hi, upper - result.shift);
    if (t0 <= t1) {
        result.hit = first_hit(own, t0, t1);
    } else {
        result.hit = no_hit(t0);
    }
    return result;
}

Cast cast_ray(Ray ray) {
    return cast_ray_between(ray, 0.0, REAL_INFINITY);
}

// Packs evaluations and status into one word; NO_ANSWER if they are no valid answer.
int packed_answer(Hit hit) {
    return is_answer(hit.status, hit.evaluations) ? hit.evaluations * 4 + hit.status : NO_ANSWER;
}
