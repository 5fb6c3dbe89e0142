// Casts a ray from the depth `lower` on, where a method has no file of its own that does so.
Cast cast_alone(Ray ray, real lower) {
    return cast_ray_between(ray, lower, REAL_INFINITY);
}
