// What a stage writes and reads for all lanes at once. Lane k is pixel (k & 3, k >> 2) of a block.
void list_single(Work work, int cell, wide root, wide slope, real start, real stop, bool whole, int spent,
                 real lean_x, real lean_y) {
    int record = next_single(work, cell);
    vstore16(root, 0, work.entries + record);
    vstore16(slope, 1, work.entries + record);
    enter_piece(work, record + 32, start, stop, whole, spent, lean_x, lean_y);
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

// Puts pixels of a block on the list of those that the last stage casts, each from a depth on.
void leave_pixels(Work work, int i0, int j0, yes which, wide from) {
    int marks[16];
    real depths[16];
    vstore16(int_lanes(which), 0, marks);
    vstore16(from, 0, depths);
    for (int k = 0; k < 16; k++) {
        int i = i0 + (k & 3);
        int j = j0 + (k >> 2);
        if (marks[k] != 0 && i < work.size && j < work.size) leave_pixel(work, j * work.size + i, depths[k]);
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

#define next_tile(work, counter, turn) next_in(work, counter)
#define LEADS true
