// A method's ray begins at its point nearest the domain's centre: its t is small however far the eye is.
OwnRay own_ray(Ray ray) {
    real shift = inner_product(difference(DOMAIN_CENTER, ray.origin), ray.direction);
    Ray near_ray = advanced_ray(ray, shift);
    return make_own_ray(near_ray, shift, domain_span(near_ray));
}
