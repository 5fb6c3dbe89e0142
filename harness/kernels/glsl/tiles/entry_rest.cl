// Runs the last stage; level is the number of levels.
__kernel void rest(__global const float *camera, __global real *t, __global int *answer, __global int *queue,
                   __global int *counts, __global real *entries, __global const real *fourths,
                   __global const float *rays, int nx, int ny, int size, int tile, int level, int ratio) {
    RESERVED
    Work work = {camera, t, answer, queue, counts, entries, fourths, rays, size, tile, level, ratio, 0,
                 get_global_id(0), get_global_size(0), numbers, bits};
    cast_left(work, vec3(camera[0], camera[1], camera[2]), vec3(camera[3], camera[4], camera[5]),
              vec3(camera[6], camera[7], camera[8]), vec3(camera[9], camera[10], camera[11]));
}
