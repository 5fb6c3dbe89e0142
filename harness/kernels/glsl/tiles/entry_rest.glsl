// Runs the last stage; level is the number of levels.
void main() {
    int id = int(gl_GlobalInvocationID.x);
    Work work = Work(size, tile, level, ratio, 0, id, int(gl_NumWorkGroups.x) * TILE_GROUP);
    cast_left(work, vec3(camera[0], camera[1], camera[2]), vec3(camera[3], camera[4], camera[5]),
              vec3(camera[6], camera[7], camera[8]), vec3(camera[9], camera[10], camera[11]));
}
