// Runs stage 2 on the single tiles of one level.
__attribute__((reqd_work_group_size(TILE_GROUP, 1, 1), vec_type_hint(wide)))
__kernel void finish(TAKES) {
    RESERVED
    Work work = WORK;
    finish_tiles(work, make_frame(work));
}
