// The harness's part of every ray: move the origin to the point nearest the domain's centre, clip, call the method.
STRUCT(Cast) struct Cast { real shift; Hit hit; };

Cast cast_ray(Ray ray) {
    Cast result;
    result.shift = inner_product(difference(DOMAIN_CENTER, ray.origin), ray.direction);
    Ray near_ray = advanced_ray(ray, result.shift);
    Span span = domain_span(near_ray);
    real t0 = max(span.lo, -result.shift);
    if (t0 <= span.hi) {
        result.hit = first_hit(near_ray, t0, span.hi);
    } else {
        result.hit = no_hit(t0);
    }
    return result;
}

int packed_answer(Hit hit) {
    return hit.evaluations * 4 + hit.status;
}
