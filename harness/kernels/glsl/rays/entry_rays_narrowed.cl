// As entry_rays, for listed rays of a camera, each narrowed to the depths of the span of its tile, `tiles[i]`.
__kernel void rays(__global const float *c, __global real *t, __global int *answer, __global const real *spans,
                   __global const float *ray_data, __global const int *tiles, int nx, int ny) {
    int i = get_global_id(0);
    if (i >= nx) return;
    __global const float *r = ray_data + 6 * i;
    Cast result = cast_narrowed_ray(make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5])), vec3(c[3], c[4], c[5]),
                                    spans[2 * tiles[i]], spans[2 * tiles[i] + 1]);
    t[2 * i] = result.shift;
    t[2 * i + 1] = result.hit.t;
    answer[i] = packed_answer(result.hit);
}
