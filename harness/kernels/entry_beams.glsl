// Level -1 empties the queues; any other runs cast_cell on its cells, strided over the nx work items.
// Without a `source` in the queue, every cell of the level is looked at.
void main() {
    int id = int(gl_GlobalInvocationID.x);
    if (level < 0) {
        if (id < 32) counts[id] = 0;
        return;
    }
    Work work = Work(size, level, last, source, target);
    int count = source < 0 ? 1 << (2 * level) : 4 * counts[level - 1];
    for (int item = id; item < count; item += nx) {
        Cell cell = source < 0 ? level_cell(work, item) : queued_cell(work, item);
        if (!outside_image(work, cell)) cast_cell(work, cell);
    }
}
