// Returns the part of `span` in which one coordinate o + t d lies between lower and upper. The result is widened by
// more than its rounding errors, so that a surface that touches a wall of the box is not cut off.
Span slab(Span span, real o, real d, real lower, real upper) {
    // a ray parallel to the walls is between them everywhere or nowhere; with the least slope the ends are far away
    real least = UNIT_ROUNDOFF * UNIT_ROUNDOFF;
    real inverse = 1.0 / (fabs(d) < least ? least : d);
    real middle = (0.5 * (lower + upper) - o) * inverse;
    real slack = 8.0 * UNIT_ROUNDOFF * (fabs(o) + max(fabs(lower), fabs(upper)));
    real half_length = (0.5 * (upper - lower) + slack) * fabs(inverse);
    return make_span(max(span.lo, middle - half_length), min(span.hi, middle + half_length));
}

// Returns the span of t in which a ray is in the domain, widened as above.
Span domain_span(Ray ray) {
    vec3 lower = DOMAIN_LOWER;
    vec3 upper = DOMAIN_UPPER;
    Span span = make_span(-REAL_INFINITY, REAL_INFINITY);
    span = slab(span, ray.origin.x, ray.direction.x, lower.x, upper.x);
    span = slab(span, ray.origin.y, ray.direction.y, lower.y, upper.y);
    return slab(span, ray.origin.z, ray.direction.z, lower.z, upper.z);
}
