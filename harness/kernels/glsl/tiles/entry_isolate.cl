// Runs stage 1 on the tiles of one level; at level -1, sets all counts to 0.
__attribute__((reqd_work_group_size(TILE_GROUP, 1, 1), vec_type_hint(wide)))
#ifdef LANES_TOGETHER
LANES_TOGETHER
#endif
__kernel void isolate(__global const float *camera, __global real *t, __global int *answer, __global int *queue,
                      __global int *counts, __global real *entries, __global const real *fourths,
                      __global const float *rays, int nx, int ny, int size, int tile, int level, int ratio) {
    int id = get_global_id(0);
    RESERVED
    Work work = {camera, t, answer, queue, counts, entries, fourths, rays, size, tile, level, ratio, id % 16,
                 id / TILE_ITEMS, (int)get_global_size(0) / TILE_ITEMS, numbers, bits};
    if (level < 0) {
        if (id == 0) for (int k = 0; k < 64; k++) counts[k] = 0;
        return;
    }
    isolate_tiles(work, make_frame(vec3(camera[0], camera[1], camera[2]), vec3(camera[3], camera[4], camera[5]),
                     vec3(camera[6], camera[7], camera[8]), vec3(camera[9], camera[10], camera[11]), size));
}
