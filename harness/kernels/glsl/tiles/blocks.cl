// What a stage writes and reads for all lanes at once. Lane k is pixel (k & 3, k >> 2) of a block.
void list_single(Work work, int cell, wide root, wide slope, real start, real stop, bool whole, int spent) {
    int slot = next_in(work, 4 * work.level + 1);
    int across = tiles_across(work.size, work.tile);
    __global real *record = work.entries + singles_at(work.size, work.tile) + SINGLE_RECORD * slot;
    work.queue[2 * tiles_before(work.size, work.tile) + across * across + slot] = cell;
    vstore16(root, 0, record);
    vstore16(slope, 1, record);
    record[32] = start;
    record[33] = stop;
    record[34] = whole ? 1.0 : 0.0;
    record[35] = real(spent);
}

// Answers the 16 pixels of the block at (i0, j0): hits where `hit`, at shift + t, else misses.
void answer_block(Work work, int i0, int j0, wide shift, wide t, yes hit, int evaluations) {
    int16 words = 4 * evaluations + (int_lanes(hit) & HIT);
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
        int place = j * across + i;
        work.answer[place] = word[k];
        if (LISTED == 0) {
            work.t[place] = shifts[k] + ts[k];
        } else {
            work.t[2 * place] = shifts[k];
            work.t[2 * place + 1] = ts[k];
        }
    }
}

// Puts pixels of a block on the list of those that the last stage casts, each from a depth on.
void leave_pixels(Work work, int i0, int j0, yes which, wide from) {
    int marks[16];
    real depths[16];
    vstore16(int_lanes(which), 0, marks);
    vstore16(from, 0, depths);
    int before = tiles_before(work.size, TILE >> LEVELS);
    for (int k = 0; k < 16; k++) {
        int i = i0 + (k & 3);
        int j = j0 + (k >> 2);
        if (marks[k] == 0 || i >= work.size || j >= work.size) continue;
        int slot = next_in(work, LEFT);
        work.queue[2 * before + slot] = j * work.size + i;
        work.entries[(OPEN_RECORD + SINGLE_RECORD) * before + slot] = depths[k];
    }
}

// Returns the listed rays of a block's pixels.
WideRay listed_rays(Work work, int i0, int j0) {
    real parts[6][16];
    for (int k = 0; k < 16; k++) {
        int i = min(i0 + (k & 3), work.size - 1);
        int j = min(j0 + (k >> 2), work.size - 1);
        for (int c = 0; c < 6; c++) parts[c][k] = work.rays[6 * (j * work.size + i) + c];
    }
    WideRay ray;
    ray.origin.x = vload16(0, parts[0]);
    ray.origin.y = vload16(0, parts[1]);
    ray.origin.z = vload16(0, parts[2]);
    ray.direction.x = vload16(0, parts[3]);
    ray.direction.y = vload16(0, parts[4]);
    ray.direction.z = vload16(0, parts[5]);
    return ray;
}
