// Returns each lane's span of t in the domain, a ball whose radius is larger by `more`; else as domain_span. An empty
// span is [infinity, -infinity].
WideSpan wide_span(WideVec3 o, WideVec3 d, real more) {
    vec3 center = DOMAIN_CENTER;
    WideVec3 from;
    from.x = o.x - center.x;
    from.y = o.y - center.y;
    from.z = o.z - center.z;
    wide squared_length = wide_inner(d, d);
    wide middle = -wide_inner(from, d) / squared_length;
    WideVec3 nearest = wide_point(from, middle, d);
    wide slack = 8.0 * UNIT_ROUNDOFF * fabs(middle);
    wide radius = DOMAIN_RADIUS + more + slack;
    wide squared_half = radius * radius * (1.0 + 16.0 * UNIT_ROUNDOFF) - wide_inner(nearest, nearest);
    wide half_length = sqrt(max(squared_half, wide(0.0)) / squared_length) * (1.0 + 4.0 * UNIT_ROUNDOFF) + slack;
    yes none = LESS(squared_half, wide(0.0));
    WideSpan span;
    span.lo = CHOOSE(none, wide(REAL_INFINITY), middle - half_length);
    span.hi = CHOOSE(none, wide(-REAL_INFINITY), middle + half_length);
    return span;
}

// Returns in which lanes points are in the domain, which is larger by `more`.
yes inside(WideVec3 p, real more) {
    vec3 center = DOMAIN_CENTER;
    WideVec3 from;
    from.x = p.x - center.x;
    from.y = p.y - center.y;
    from.z = p.z - center.z;
    real radius = DOMAIN_RADIUS + more;
    return LESS(wide_inner(from, from), wide(radius * radius));
}
