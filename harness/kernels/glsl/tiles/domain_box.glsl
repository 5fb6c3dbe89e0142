// Returns the part of `span` in which one coordinate o + t d lies between lower - more and upper + more; else as slab.
WideSpan wide_slab(WideSpan span, wide o, wide d, real lower, real upper, real more) {
    wide tiny = wide(UNIT_ROUNDOFF * UNIT_ROUNDOFF);
    wide inverse = 1.0 / CHOOSE(LESS(fabs(d), tiny), tiny, d);
    wide middle = (0.5 * (lower + upper) - o) * inverse;
    wide slack = 8.0 * UNIT_ROUNDOFF * (fabs(o) + max(fabs(lower), fabs(upper))) + more;
    wide half_length = (0.5 * (upper - lower) + slack) * fabs(inverse);
    WideSpan result;
    result.lo = max(span.lo, middle - half_length);
    result.hi = min(span.hi, middle + half_length);
    return result;
}

// Returns each lane's span of t in the domain, a box that is larger by `more` on each side. An empty span is
// [infinity, -infinity].
WideSpan wide_span(WideVec3 o, WideVec3 d, real more) {
    vec3 lower = DOMAIN_LOWER;
    vec3 upper = DOMAIN_UPPER;
    WideSpan span;
    span.lo = wide(-REAL_INFINITY);
    span.hi = wide(REAL_INFINITY);
    span = wide_slab(span, o.x, d.x, lower.x, upper.x, more);
    span = wide_slab(span, o.y, d.y, lower.y, upper.y, more);
    span = wide_slab(span, o.z, d.z, lower.z, upper.z, more);
    yes none = MORE(span.lo, span.hi);
    span.lo = CHOOSE(none, wide(REAL_INFINITY), span.lo);
    span.hi = CHOOSE(none, wide(-REAL_INFINITY), span.hi);
    return span;
}

// Returns in which lanes points are in the domain, which is larger by `more`.
yes inside(WideVec3 p, real more) {
    vec3 lower = DOMAIN_LOWER;
    vec3 upper = DOMAIN_UPPER;
    yes within = BOTH(MORE(p.x, wide(lower.x - more)), LESS(p.x, wide(upper.x + more)));
    within = BOTH(within, BOTH(MORE(p.y, wide(lower.y - more)), LESS(p.y, wide(upper.y + more))));
    within = BOTH(within, BOTH(MORE(p.z, wide(lower.z - more)), LESS(p.z, wide(upper.z + more))));
    return within;
}
