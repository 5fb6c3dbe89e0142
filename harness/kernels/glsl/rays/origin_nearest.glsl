// A method's ray begins at its point nearest the domain's centre: its t is small however far the eye is.
real own_shift(Ray ray) {
    return inner_product(difference(DOMAIN_CENTER, ray.origin), ray.direction);
}

Span own_span(Ray ray, Ray own, real shift) {
    return domain_span(own);
}
