// What isolation writes for a tile where sixteen work items have one lane each.

void list_single(Work work, int cell, real root, real slope, real start, real stop, bool whole, int spent,
                 real lean_x, real lean_y) {
    int slot = shared_place(work, 4 * work.level + 1);
    int before = tiles_before(work.size, work.tile);
    int across = tiles_across(work.size, work.tile);
    int record = singles_at(work.size, work.tile) + SINGLE_RECORD * slot;
    enqueue(work, QUEUE_RECORD * before + across * across + slot, cell);
    enter(work, record + OWN_LANE, root);
    enter(work, record + 16 + OWN_LANE, slope);
    enter(work, record + 32, start);
    enter(work, record + 33, stop);
    enter(work, record + 34, whole ? real(1) : real(0));
    enter(work, record + 35, real(spent));
    enter(work, record + 36, lean_x);
    enter(work, record + 37, lean_y);
}

// Answers that all pixels of a tile miss.
void answer_empty(Work work, int i0, int j0, int evaluations) {
    int word = answer_word(MISS, work.level, evaluations);
    for (int k = OWN_LANE; k < work.tile * work.tile; k += 16) {
        int i = i0 + k % work.tile;
        int j = j0 + k / work.tile;
        if (i < work.size && j < work.size) set_answer(work, j * work.size + i, word);
    }
}
