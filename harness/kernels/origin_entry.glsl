// A method's ray begins where it enters the domain, or at the eye within it: its t runs from about 0.
OwnRay own_ray(Ray ray) {
    Span span = domain_span(ray);
    real shift = max(span.lo, real(0));
    return make_own_ray(advanced_ray(ray, shift), shift, make_span(span.lo - shift, span.hi - shift));
}
