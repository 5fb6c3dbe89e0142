// Runs stage 2 on the single tiles of one level.
void main() {
    int id = int(gl_GlobalInvocationID.x);
    Work work = Work(size, tile, level, ratio, id % 16, id / TILE_ITEMS, int(gl_NumWorkGroups.x) * TILE_GROUP / TILE_ITEMS);
    finish_tiles(work, make_frame(vec3(camera[0], camera[1], camera[2]), vec3(camera[3], camera[4], camera[5]),
                                  vec3(camera[6], camera[7], camera[8]), vec3(camera[9], camera[10], camera[11]), size));
}
