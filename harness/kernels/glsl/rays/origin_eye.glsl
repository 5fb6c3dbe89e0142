// A method's ray begins at the eye, as it is given: its t has the roundings of the eye's distance.
real own_shift(Ray ray) {
    return 0.0;
}

Span own_span(Ray ray, Ray own, real shift) {
    return domain_span(own);
}
