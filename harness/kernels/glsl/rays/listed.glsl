// Returns the first hit of a listed ray with t >= T_MIN. A ray that starts on the surface hits it there, in whatever
// direction it goes and whatever the method. It starts on the surface if its start is in the domain and f there is
// exactly 0 in this program's own arithmetic.
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
