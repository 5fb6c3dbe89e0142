// As entry_rays, for listed rays of a camera, each narrowed to the depths of the span of its tile, `tiles[i]`.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input0 { float c[]; };
layout(std430, binding = 1) writeonly buffer Output0 { real t[]; };
layout(std430, binding = 2) writeonly buffer Output1 { int answer[]; };
layout(std430, binding = 3) readonly buffer Input1 { real spans[]; };
layout(std430, binding = 4) readonly buffer Input2 { float ray_data[]; };
layout(std430, binding = 5) readonly buffer Input3 { int tiles[]; };
uniform int nx;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= nx) return;
    int k = 6 * i;
    Ray ray = make_ray(vec3(ray_data[k], ray_data[k + 1], ray_data[k + 2]),
                       vec3(ray_data[k + 3], ray_data[k + 4], ray_data[k + 5]));
    Cast result = cast_narrowed_ray(ray, vec3(c[3], c[4], c[5]), spans[2 * tiles[i]], spans[2 * tiles[i] + 1]);
    t[2 * i] = result.shift;
    t[2 * i + 1] = result.hit.t;
    if (loops_were_ended(nx)) result.hit = exhausted(result.hit, result.hit.t);
    answer[i] = packed_answer(result.hit);
}
