// Casts the ray of one fragment of a proxy at its instance. Shades the first hit and writes its depth; discards the
// fragment if there is none.
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
