// Casts a ray at the torus of torus.glsl for each fragment of a proxy. For fingerprints: a fragment that misses is drawn
// too, at the end of its ray, and the depth that was interpolated is reported in place of the ray's shift.
layout(depth_greater) out float gl_FragDepth;
layout(location = 0) out vec4 picture;
void main() {
    Ray world = pixel_ray();
    Ray ray = local_ray(world);
    real shift = -inner_product(ray.origin, ray.direction);
    real c[5];
    torus_along(advanced_ray(ray, shift), c);
    Hit hit = newton_hit(c, -1.25, 1.25);
    report_fragment(world, hit.evaluations, hit.status);
    real t = shift + hit.t;
    gl_FragDepth = hit_depth(world, t);
    picture = lit(instance_colour_scale.xyz, unit_vector(torus_gradient(ray_point(ray, t))), ray.direction);
    report_seen(ray, gl_FragCoord.z, t, instance, false);
}
