// A method's ray begins at the eye, as it is given: its t has the roundings of the eye's distance.
OwnRay own_ray(Ray ray) {
    return make_own_ray(ray, 0.0, domain_span(ray));
}
