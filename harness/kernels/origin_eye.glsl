// A method's rays begin at the eye, as they are given: its t has the roundings of the eye's distance.
real origin_shift(Ray ray) {
    return 0.0;
}

Ray ray_from_origin(Ray ray, real shift) {
    return ray;
}
