// What a stage writes and reads for all lanes at once. Lane k is pixel (k & 3, k >> 2) of a block.
void enter_single(Work work, int place, wide root, wide slope, real start, real stop, bool whole, real lean_x,
                  real lean_y) {
    vstore16(root, 0, work.entries + place);
    vstore16(slope, 1, work.entries + place);
    enter_piece(work, place + 32, start, stop, whole, lean_x, lean_y);
}

// Answers the 16 pixels of the block at (i0, j0): hits where `hit`, at shift + t, else misses.
void answer_block(Work work, int i0, int j0, wide shift, wide t, yes hit, int stage, int evaluations) {
    int16 words = answer_word(MISS, stage, evaluations) + (int_lanes(hit) & HIT);
    int across = work.size;
    if (LISTED == 0 && i0 + 4 <= across && j0 + 4 <= across) {
        __global real *to = work.t + j0 * across + i0;
        __global int *word = work.answer + j0 * across + i0;
        wide whole = shift + t;
        vstore4(whole.s0123, 0, to);
        vstore4(whole.s4567, 0, to + across);
        vstore4(whole.s89ab, 0, to + 2 * across);
        vstore4(whole.scdef, 0, to + 3 * across);
        vstore4(words.s0123, 0, word);
        vstore4(words.s4567, 0, word + across);
        vstore4(words.s89ab, 0, word + 2 * across);
        vstore4(words.scdef, 0, word + 3 * across);
        return;
    }
    real shifts[16];
    real ts[16];
    int word[16];
    vstore16(shift, 0, shifts);
    vstore16(t, 0, ts);
    vstore16(words, 0, word);
    for (int k = 0; k < 16; k++) {
        int i = i0 + (k & 3);
        int j = j0 + (k >> 2);
        if (i >= across || j >= across) continue;
        answer_pixel(work, j * across + i, shifts[k], ts[k], word[k]);
    }
}

// Marks pixels of a block whose first root in the domain is still to be found in a second piece.
void pass_pixels(Work work, int i0, int j0, yes which) {
    int marks[16];
    vstore16(int_lanes(which), 0, marks);
    for (int k = 0; k < 16; k++) {
        int i = i0 + (k & 3);
        int j = j0 + (k >> 2);
        int place = j * work.size + i;
        if (marks[k] != 0 && i < work.size && j < work.size) set_answer(work, place, passed_word(answered(work, place)));
    }
}

// Returns which pixels of a block are marked.
yes passed_pixels(Work work, int i0, int j0) {
    real marks[16];
    for (int k = 0; k < 16; k++) {
        int i = i0 + (k & 3);
        int j = j0 + (k >> 2);
        bool marked = i < work.size && j < work.size && is_passed(answered(work, j * work.size + i));
        marks[k] = marked ? real(1) : real(0);
    }
    return MORE(vload16(0, marks), wide(0.0));
}

// Answers some pixels of a block, as answer_block, and adds to their evaluations.
void answer_again(Work work, int i0, int j0, yes which, wide shift, wide t, yes hit, int stage, int evaluations) {
    int marks[16];
    int hits[16];
    real shifts[16];
    real ts[16];
    vstore16(int_lanes(which), 0, marks);
    vstore16(int_lanes(hit), 0, hits);
    vstore16(shift, 0, shifts);
    vstore16(t, 0, ts);
    for (int k = 0; k < 16; k++) {
        int place = (j0 + (k >> 2)) * work.size + i0 + (k & 3);
        if (marks[k] == 0) continue;
        int word = answer_word(hits[k] != 0 ? HIT : MISS, stage, (answered(work, place) >> 7) + evaluations);
        answer_pixel(work, place, shifts[k], ts[k], word);
    }
}

// Puts pixels of a block on the list of those that the last stage casts, each from a depth on.
void leave_pixels(Work work, int i0, int j0, yes which, wide from) {
    int marks[16];
    real depths[16];
    vstore16(int_lanes(which), 0, marks);
    vstore16(from, 0, depths);
    int count = 0;
    for (int k = 0; k < 16; k++) {
        marks[k] = marks[k] != 0 && i0 + (k & 3) < work.size && j0 + (k >> 2) < work.size ? 1 : 0;
        count += marks[k];
    }
    int slot = atomic_add(&work.counts[LEFT], count);
    for (int k = 0; k < 16; k++) {
        if (marks[k] == 0) continue;
        leave_in(work, slot, (j0 + (k >> 2)) * work.size + i0 + (k & 3), depths[k]);
        slot += 1;
    }
}

// Returns the rays of a block's pixels, with the listed ones in place of the camera's.
WideRay with_listed(Work work, int i0, int j0, WideRay rays) {
    real parts[6][16];
    vstore16(rays.origin.x, 0, parts[0]);
    vstore16(rays.origin.y, 0, parts[1]);
    vstore16(rays.origin.z, 0, parts[2]);
    vstore16(rays.direction.x, 0, parts[3]);
    vstore16(rays.direction.y, 0, parts[4]);
    vstore16(rays.direction.z, 0, parts[5]);
    for (int k = 0; k < 16; k++) {
        int place = listed_place(work, i0 + (k & 3), j0 + (k >> 2));
        for (int c = 0; c < 6 && place >= 0; c++) parts[c][k] = work.rays[place + c];
    }
    WideRay result;
    result.origin.x = vload16(0, parts[0]);
    result.origin.y = vload16(0, parts[1]);
    result.origin.z = vload16(0, parts[2]);
    result.direction.x = vload16(0, parts[3]);
    result.direction.y = vload16(0, parts[4]);
    result.direction.z = vload16(0, parts[5]);
    return result;
}

// Returns the next of `total` tiles that a work item is to do. It takes several at once, since a counter that processors
// share is slow, but few enough that no other one waits long in the end.
#define MOST_AT_ONCE 16
#define next_tile(work, counter, total, turn) next_taken(&(work), counter, total)

int next_taken(Work *work, int counter, int total) {
    if (work->left == 0) {
        work->left = clamp(total / (4 * work->items), 1, MOST_AT_ONCE);
        work->taken = atomic_add(&work->counts[counter], work->left);
    }
    work->left -= 1;
    work->taken += 1;
    return work->taken - 1;
}

#define LEADS true
