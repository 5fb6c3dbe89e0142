// The method sees its ray begin at the eye, as given; a far eye makes t, and so its rounding errors, large.
real own_shift(Ray ray) {
    return 0.0;
}

Span own_span(Ray ray, Ray own, real shift) {
    return domain_span(own);
}
