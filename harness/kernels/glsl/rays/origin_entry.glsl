// A method's ray begins where it enters the domain, or at the eye within it: its t runs from about 0.
real own_shift(Ray ray) {
    return max(domain_span(ray).lo, real(0));
}

Span own_span(Ray ray, Ray own, real shift) {
    Span span = domain_span(ray);
    return make_span(span.lo - shift, span.hi - shift);
}
