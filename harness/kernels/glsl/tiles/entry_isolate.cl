// Runs stage 1 on the tiles of one level; at level -1, sets all counts to 0.
__attribute__((reqd_work_group_size(TILE_GROUP, 1, 1), vec_type_hint(wide)))
#ifdef LANES_TOGETHER
LANES_TOGETHER
#endif
__kernel void isolate(TAKES) {
    RESERVED
    Work work = WORK;
    if (level < 0) {
        if (get_global_id(0) == 0) for (int k = 0; k < 64; k++) counts[k] = 0;
        return;
    }
    isolate_tiles(work, make_frame(work));
}
