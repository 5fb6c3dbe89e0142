#define ALL_IN_ROWS (-2)

// A cell of the quadtree over the image. Cell (x, y) of `level` is 2^(last - level) pixels wide, so one pixel at
// `last`. Its parent handed down `path`, the piece of depth to begin with (see path_depth), and `evaluations`, the
// cell's share of the evaluations spent so far; NO_ANSWER if these are no count.
STRUCT(Cell) struct Cell { int x; int y; int level; int path; int evaluations; };

// Returns bits 0, 2, 4, … of v, packed.
int even_bits(int v) {
    int a = v & 0x55555555;
    a = (a | (a >> 1)) & 0x33333333;
    a = (a | (a >> 2)) & 0x0f0f0f0f;
    a = (a | (a >> 4)) & 0x00ff00ff;
    return (a | (a >> 8)) & 0x0000ffff;
}

// Returns cell number `item` of a level all of whose cells are searched. Cells are numbered in Z order, so that
// neighbouring work items have neighbouring cells; if `source` is ALL_IN_ROWS, row by row.
Cell level_cell(Work work, int item) {
    bool in_rows = work.source == ALL_IN_ROWS;
    Cell cell;
    cell.x = in_rows ? item & ((1 << work.level) - 1) : even_bits(item);
    cell.y = in_rows ? item >> work.level : even_bits(item >> 1);
    cell.level = work.level;
    cell.path = 1;
    cell.evaluations = 0;
    return cell;
}

// Returns how many cells of `level` are in the image, which is the most that the level can queue.
int most_queued(Work work, int level) {
    int across = (work.size + (1 << (work.last - level)) - 1) >> (work.last - level);
    return across * across;
}

// Returns quarter `item` % 4 of the queue's cell `item` / 4. The four quarters share the evaluations of their parent.
// The queue is filled from both ends: cells from its end come after all those from its front.
Cell queued_cell(Work work, int item) {
    int parent = item >> 2;
    if (parent >= work.front) parent = most_queued(work, work.level - 1) - 1 - (parent - work.front);
    int place = work.source + 3 * parent;
    int quarter = item & 3;
    int corner = queued(work, place);
    Cell cell;
    cell.x = 2 * (corner & 0xffff) + (quarter & 1);
    cell.y = 2 * ((corner >> 16) & 0xffff) + (quarter >> 1);
    cell.level = work.level;
    cell.path = queued(work, place + 1);
    int evaluations = queued(work, place + 2);
    cell.evaluations = evaluations < 0 ? NO_ANSWER : (evaluations + quarter) >> 2;
    return cell;
}

// Returns the evaluations of a cell and its share of its parents'; NO_ANSWER if either, or their sum, is no count.
int spent(Cell cell, Hit hit) {
    if (!is_answer(MISS, cell.evaluations) || !is_answer(MISS, hit.evaluations)) return NO_ANSWER;
    int evaluations = cell.evaluations + hit.evaluations;
    return is_answer(MISS, evaluations) ? evaluations : NO_ANSWER;
}

bool outside_image(Work work, Cell cell) {
    int side = 1 << (work.last - work.level);
    return max(cell.x, cell.y) * side >= work.size;
}

Beam cell_beam(Work work, Cell cell) {
    int side = 1 << (work.last - work.level);
    int i0 = cell.x * side;
    int j0 = cell.y * side;
    return camera_beam(work.camera, i0, j0, min(i0 + side, work.size), min(j0 + side, work.size), work.size);
}

// Queues the cell for the next level, where its quarters begin at piece `path`. The quarters of cells queued with
// `later` come after those of all others.
void queue_cell(Work work, Cell cell, int path, Hit hit, bool later) {
    int slot = queue_slot(work, later ? work.level + 16 : work.level);
    if (later) slot = most_queued(work, work.level) - 1 - slot;
    int place = work.target + 3 * slot;
    enqueue(work, place, cell.x | (cell.y << 16));
    enqueue(work, place + 1, path);
    enqueue(work, place + 2, spent(cell, hit));
}

void queue_quarters(Work work, Cell cell, int path, Hit hit) {
    queue_cell(work, cell, path, hit, false);
}

// Packs evaluations, level and status into one word; NO_ANSWER if they are no valid answer.
int answer_word(int evaluations, Cell cell, int status) {
    return is_answer(status, evaluations) ? ((evaluations * 32) + cell.level) * 4 + status : NO_ANSWER;
}

// Writes the cell's answer to all its pixels: status, level, and to each pixel its share of the evaluations. Only a
// cell of one pixel can be a hit; its t is a depth, and the distance along the ray through the pixel's middle is
// stored. If the driver has ended the cell's loops early, the cell is exhausted.
void paint(Work work, Cell cell, Hit hit) {
    int evaluations = spent(cell, hit);
    int status = loops_were_ended(work) ? EXHAUSTED : hit.status;
    if (work.level == work.last) {
        Camera camera = work.camera;
        real x = real(2 * cell.x + 1 - work.size) / real(work.size);
        real y = real(work.size - 2 * cell.y - 1) / real(work.size);
        vec3 direction = moved(moved(camera.forward, x, camera.right), y, camera.up);
        answer_pixel(work, cell.y * work.size + cell.x, hit.t * sqrt(inner_product(direction, direction)),
                     answer_word(evaluations, cell, status));
        return;
    }
    if (status == HIT) status = NO_ANSWER;
    int side = 1 << (work.last - work.level);
    int i0 = cell.x * side;
    int j0 = cell.y * side;
    int i1 = min(i0 + side, work.size);
    int j1 = min(j0 + side, work.size);
    int pixels = (i1 - i0) * (j1 - j0);
    if (evaluations < 0) status = NO_ANSWER;
    int share = evaluations / pixels;
    int extra = evaluations - share * pixels;  // so many pixels take one more, so that all shares add up
    for (int j = j0; j < j1; j++) {
        for (int i = i0; i < i1; i++) {
            answer_pixel(work, j * work.size + i, 0.0, answer_word(share + (extra > 0 ? 1 : 0), cell, status));
            extra -= 1;
        }
    }
}
