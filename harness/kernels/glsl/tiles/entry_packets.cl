// Runs stage 3 on the open tiles of the last level; nothing if the last stage casts their pixels.
__attribute__((reqd_work_group_size(TILE_GROUP, 1, 1), vec_type_hint(wide)))
__kernel void packets(TAKES) {
    RESERVED
    Work work = WORK;
    if (OPEN_TILES == 0) cast_packets(work, make_frame(work));
}
