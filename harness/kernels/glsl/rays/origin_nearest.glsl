// The method sees its ray begin at the point nearest to the domain's centre; t is small however far the eye is.
real own_shift(Ray ray) {
    return inner_product(difference(DOMAIN_CENTER, ray.origin), ray.direction);
}

Span own_span(Ray ray, Ray own, real shift) {
    return domain_span(own);
}
