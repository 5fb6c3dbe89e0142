// As entry_camera, but each ray is narrowed to the depths of its tile's span, which the prepass has written to `spans`.
__kernel void camera(__global const float *c, __global real *t, __global int *answer, __global const real *spans,
                     int nx, int ny) {
    int i = get_global_id(0);
    int j = get_global_id(1);
    if (i >= nx || j >= ny) return;
    int tile = (j >> TILE_BITS) * ((nx + (1 << TILE_BITS) - 1) >> TILE_BITS) + (i >> TILE_BITS);
    vec3 forward = vec3(c[3], c[4], c[5]);
    Ray ray = camera_ray(vec3(c[0], c[1], c[2]), forward, vec3(c[6], c[7], c[8]), vec3(c[9], c[10], c[11]), i, j, nx, ny);
    Cast result = cast_narrowed_ray(ray, forward, spans[2 * tile], spans[2 * tile + 1]);
    t[j * nx + i] = result.shift + result.hit.t;
    answer[j * nx + i] = packed_answer(result.hit);
}
