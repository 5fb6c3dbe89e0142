// A method's rays begin where they enter the domain, or at the eye within it: its t runs from about 0.
real origin_shift(Ray ray) {
    return max(domain_span(ray).lo, real(0));
}

Ray ray_from_origin(Ray ray, real shift) {
    return advanced_ray(ray, shift);
}
