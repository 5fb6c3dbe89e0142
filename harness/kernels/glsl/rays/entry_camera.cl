// Casts the ray of one sample of a camera's image per work item. `c` is the camera: eye, forward, right, up, 12
// float32.
__kernel void camera(__global const float *c, __global real *t, __global int *answer, int nx, int ny) {
    int i = get_global_id(0);
    int j = get_global_id(1);
    if (i >= nx || j >= ny) return;
    Cast result = cast_ray(camera_ray(vec3(c[0], c[1], c[2]), vec3(c[3], c[4], c[5]), vec3(c[6], c[7], c[8]),
                                      vec3(c[9], c[10], c[11]), i, j, nx, ny));
    t[j * nx + i] = result.shift + result.hit.t;
    answer[j * nx + i] = packed_answer(result.hit);
}
