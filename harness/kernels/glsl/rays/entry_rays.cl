// Casts one listed ray per work item: origin and direction, 6 float32. t is written in two parts whose sum is taken
// on the host, so that it keeps its last bits.
__kernel void rays(__global const float *ray_data, __global real *t, __global int *answer, int nx, int ny) {
    int i = get_global_id(0);
    if (i >= nx) return;
    __global const float *r = ray_data + 6 * i;
    Cast result = cast_listed_ray(make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5])));
    t[2 * i] = result.shift;
    t[2 * i + 1] = result.hit.t;
    answer[i] = packed_answer(result.hit);
}
