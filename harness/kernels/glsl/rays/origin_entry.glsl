// The method sees its ray begin where the ray enters the domain, or at the eye if that is inside; t begins near 0.
real own_shift(Ray ray) {
    return max(domain_span(ray).lo, real(0));
}

Span own_span(Ray ray, Ray own, real shift) {
    Span span = domain_span(ray);
    return make_span(span.lo - shift, span.hi - shift);
}
