// The first hit of a listed ray with t >= T_MIN. A ray that starts on the surface hits it there, whichever way it goes and
// whatever the method: on the surface is where f is zero in this program's own arithmetic, at a point of the domain.
Cast cast_listed_ray(Ray ray) {
    Ray start = advanced_ray(ray, T_MIN);
    Span stay = domain_span(start);
    if (stay.lo <= 0.0 && stay.hi >= 0.0 && surface_value(start.origin) == 0.0) {
        Cast result;
        result.shift = T_MIN;
        result.hit = hit_at(no_hit(0.0), 0.0);
        result.hit.evaluations = 1;
        return result;
    }
    return cast_ray_between(ray, T_MIN, REAL_INFINITY);
}
