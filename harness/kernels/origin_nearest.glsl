// A method's rays begin at their point nearest the domain's centre: its t is small however far the eye is.
real origin_shift(Ray ray) {
    return inner_product(difference(DOMAIN_CENTER, ray.origin), ray.direction);
}

Ray ray_from_origin(Ray ray, real shift) {
    return advanced_ray(ray, shift);
}
