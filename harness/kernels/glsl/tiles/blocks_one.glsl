// What a stage writes and reads where a work item has one lane, `work.lane`, of the sixteen that share a tile or a block.
#define next_tile(work, counter, total, turn) ((work).item + (turn) * (work).items)

// Answers the lane's pixel of the block at (i0, j0): a hit at shift + t where `hit`, else a miss.
void answer_block(Work work, int i0, int j0, real shift, real t, bool hit, int stage, int evaluations) {
    int i = i0 + OWN_LANE % BLOCK_WIDTH;
    int j = j0 + OWN_LANE / BLOCK_WIDTH;
    if (i >= work.size || j >= work.size) return;
    answer_pixel(work, j * work.size + i, shift, t, answer_word(hit ? HIT : MISS, stage, evaluations));
}

// Marks the lane's pixel, if its first root in the domain is still to be found in a second piece.
void pass_pixels(Work work, int i0, int j0, bool which) {
    int i = i0 + OWN_LANE % BLOCK_WIDTH;
    int j = j0 + OWN_LANE / BLOCK_WIDTH;
    int place = j * work.size + i;
    if (which && i < work.size && j < work.size) set_answer(work, place, passed_word(answered(work, place)));
}

// Tells whether the lane's pixel is marked.
bool passed_pixels(Work work, int i0, int j0) {
    int i = i0 + OWN_LANE % BLOCK_WIDTH;
    int j = j0 + OWN_LANE / BLOCK_WIDTH;
    return i < work.size && j < work.size && is_passed(answered(work, j * work.size + i));
}

// Answers the lane's pixel if it is marked, as answer_block, and adds to its evaluations.
void answer_again(Work work, int i0, int j0, bool which, real shift, real t, bool hit, int stage, int evaluations) {
    int place = (j0 + OWN_LANE / BLOCK_WIDTH) * work.size + i0 + OWN_LANE % BLOCK_WIDTH;
    int before = which ? answered(work, place) >> 7 : 0;
    if (which) answer_pixel(work, place, shift, t, answer_word(hit ? HIT : MISS, stage, before + evaluations));
}

// Puts the lane's pixel on the list of those that the last stage casts, each from a depth on.
void leave_pixels(Work work, int i0, int j0, bool which, real from) {
    int i = i0 + OWN_LANE % BLOCK_WIDTH;
    int j = j0 + OWN_LANE / BLOCK_WIDTH;
    if (which && i < work.size && j < work.size) leave_pixel(work, j * work.size + i, from);
}

// Returns the ray of the lane's pixel in a block: the listed one where there is one.
WideRay with_listed(Work work, int i0, int j0, WideRay ray) {
    WideRay result = ray;
    int place = listed_place(work, i0 + OWN_LANE % BLOCK_WIDTH, j0 + OWN_LANE / BLOCK_WIDTH);
    if (place >= 0) {
        result.origin.x = ray_at(work, place);
        result.origin.y = ray_at(work, place + 1);
        result.origin.z = ray_at(work, place + 2);
        result.direction.x = ray_at(work, place + 3);
        result.direction.y = ray_at(work, place + 4);
        result.direction.z = ray_at(work, place + 5);
    }
    return result;
}
