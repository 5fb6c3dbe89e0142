// The span a ray spends in the box, widened by a few roundings: a surface that touches a wall is not cut off.
Span slab(Span span, real o, real d, real lower, real upper) {
    if (d == 0.0) return (o < lower || o > upper) ? make_span(1.0, 0.0) : span;
    real inverse = 1.0 / d;
    real a = (lower - o) * inverse;
    real b = (upper - o) * inverse;
    real slack = 4.0 * UNIT_ROUNDOFF * (fabs(o) + max(fabs(lower), fabs(upper))) * fabs(inverse);
    return make_span(max(span.lo, min(a, b) - slack), min(span.hi, max(a, b) + slack));
}

Span domain_span(Ray ray) {
    vec3 lower = DOMAIN_LOWER;
    vec3 upper = DOMAIN_UPPER;
    Span span = make_span(-REAL_INFINITY, REAL_INFINITY);
    span = slab(span, ray.origin.x, ray.direction.x, lower.x, upper.x);
    span = slab(span, ray.origin.y, ray.direction.y, lower.y, upper.y);
    return slab(span, ray.origin.z, ray.direction.z, lower.z, upper.z);
}
