// Returns the first hit of a ray between the depths s0 and s1 along `forward`, which the prepass found; a miss if s0
// > s1.
Cast cast_narrowed_ray(Ray ray, vec3 forward, real s0, real s1) {
    real per_depth = 1.0 / inner_product(ray.direction, forward);
    if (s0 <= s1) return cast_ray_between(ray, max(s0, real(0)) * per_depth, s1 * per_depth);
    Cast result;
    result.shift = 0.0;
    result.hit = no_hit(0.0);
    return result;
}
