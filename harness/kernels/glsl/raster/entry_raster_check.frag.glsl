// As entry_raster, and reports what the method answered.
layout(depth_greater) out float gl_FragDepth;
layout(location = 0) out vec4 picture;
void main() {
    Ray world = pixel_ray();
    Ray ray = local_ray(world);
    Cast result = cast_ray(ray);
    if (loops_were_ended(size)) result.hit = exhausted(result.hit, result.hit.t);
    bool nowhere = result.hit.status == HIT && !(fabs(result.hit.t) < REAL_INFINITY);
    report_fragment(world, result.hit.evaluations, nowhere ? NO_ANSWER : result.hit.status);
    if (result.hit.status != HIT) discard;
    real t = result.shift + result.hit.t;
    gl_FragDepth = hit_depth(world, t);
    picture = lit(instance_colour_scale.xyz, SHADING_NORMAL(ray_point(ray, t)), ray.direction);
    report_seen(ray, result.shift, result.hit.t, instance, false);
}
