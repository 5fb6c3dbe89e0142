// One fragment of a proxy: the instance's first hit, shaded, with its depth; discarded without one.
layout(depth_greater) out float gl_FragDepth;
layout(location = 0) out vec4 picture;
void main() {
    Ray world = pixel_ray();
    Ray ray = local_ray(world);
    Cast result = cast_ray(ray);
    if (result.hit.status != HIT) discard;
    real t = result.shift + result.hit.t;
    gl_FragDepth = hit_depth(world, t);
    picture = lit(instance_colour_scale.xyz, SHADING_NORMAL(ray_point(ray, t)), ray.direction);
}
