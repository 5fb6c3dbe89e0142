// Returns the ray through the middle of sample (i, j) of an image of nx by ny samples; row 0 is the top.
Ray camera_ray(vec3 eye, vec3 forward, vec3 right, vec3 up, int i, int j, int nx, int ny) {
    real x = (real(2 * i + 1) - real(nx)) / real(nx);
    real y = (real(ny) - real(2 * j + 1)) / real(ny);
    vec3 to = moved(moved(forward, x, right), y, up);
    real inverse = 1.0 / sqrt(inner_product(to, to));
    return make_ray(eye, vec3(to.x * inverse, to.y * inverse, to.z * inverse));
}
