// Returns the span of t in which a ray is in the domain, a ball. It is widened by more than its rounding errors,
// those of a far origin included, so that a surface that touches the sphere is not cut off.
Span domain_span(Ray ray) {
    vec3 o = difference(ray.origin, DOMAIN_CENTER);
    real squared_length = inner_product(ray.direction, ray.direction);
    real middle = -inner_product(o, ray.direction) / squared_length;
    vec3 nearest = moved(o, middle, ray.direction);
    real slack = 8.0 * UNIT_ROUNDOFF * fabs(middle);
    real squared_radius = (DOMAIN_RADIUS + slack) * (DOMAIN_RADIUS + slack);
    real squared_half = squared_radius * (1.0 + 16.0 * UNIT_ROUNDOFF) - inner_product(nearest, nearest);
    if (squared_half < 0.0) return make_span(1.0, 0.0);
    real half_length = sqrt(squared_half / squared_length) * (1.0 + 4.0 * UNIT_ROUNDOFF) + slack;
    return make_span(middle - half_length, middle + half_length);
}
