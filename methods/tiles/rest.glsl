// Stage 4. Casts a ray from the depth `lower` on by bernstein's kernel, and corrects its root.
Cast cast_alone(Ray ray, real lower) {
    Cast result = cast_ray_between(ray, lower, REAL_INFINITY);
    if (result.hit.status != HIT) return result;
    Ray own = advanced_ray(ray, result.shift);
    Span span = own_span(ray, own, result.shift);
    real start = max(span.lo, lower - result.shift);
    real sign = surface_value(ray_point(own, start)) > 0.0 ? real(-1) : real(1);
    WideVec3 o;
    WideVec3 d;
    o.x = ray.origin.x;
    o.y = ray.origin.y;
    o.z = ray.origin.z;
    d.x = ray.direction.x;
    d.y = ray.direction.y;
    d.z = ray.direction.z;
    Corrected found = corrected(o, result.shift, d, result.hit.t, start, span.hi, sign, 0.0, 1.0, true);
    result.hit.evaluations += 1 + found.evaluations;
    if (found.good) result.hit.t = found.t;
    return result;
}
