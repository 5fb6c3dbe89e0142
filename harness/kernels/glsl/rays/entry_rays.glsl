// Casts one listed ray per work item: origin and direction, 6 float32. t is written in two parts whose sum is taken
// on the host, so that it keeps its last bits.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input0 { float ray_data[]; };
layout(std430, binding = 1) writeonly buffer Output0 { real t[]; };
layout(std430, binding = 2) writeonly buffer Output1 { int answer[]; };
uniform int nx;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= nx) return;
    int k = 6 * i;
    Cast result = cast_listed_ray(make_ray(vec3(ray_data[k], ray_data[k + 1], ray_data[k + 2]),
                                           vec3(ray_data[k + 3], ray_data[k + 4], ray_data[k + 5])));
    t[2 * i] = result.shift;
    t[2 * i + 1] = result.hit.t;
    if (loops_were_ended(nx)) result.hit = exhausted(result.hit, result.hit.t);
    answer[i] = packed_answer(result.hit);
}
