// At level -1, empties the queues. At any other level, runs cast_cell on the level's cells, strided over the nx work
// items: on those queued at `source`, or on every cell of the level if `source` is negative.
void main() {
    int id = int(gl_GlobalInvocationID.x);
    if (level < 0) {
        if (id < 32) counts[id] = 0;
        return;
    }
    Camera camera = make_camera(vec3(c[0], c[1], c[2]), vec3(c[3], c[4], c[5]), vec3(c[6], c[7], c[8]),
                                vec3(c[9], c[10], c[11]));
    int front = source < 0 ? 0 : counts[level - 1];
    int count = source < 0 ? 1 << (2 * level) : 4 * (front + counts[level + 15]);
    Work work = Work(camera, size, level, last, source, target, front);
    for (int item = id; item < count; item += nx) {
        Cell cell = source < 0 ? level_cell(work, item) : queued_cell(work, item);
        if (!outside_image(work, cell)) cast_cell(work, cell);
    }
}
