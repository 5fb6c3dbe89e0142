// What isolation writes for a tile where one work item has all sixteen lanes.
#define LEADS true

void list_single(Work work, int cell, Lanes root, Lanes slope, real start, real stop, bool whole, int spent,
                 real lean_x, real lean_y) {
    int slot = next_in(work, 4 * work.level + 1);
    int before = tiles_before(work.size, work.tile);
    int across = tiles_across(work.size, work.tile);
    int record = singles_at(work.size, work.tile) + SINGLE_RECORD * slot;
    enqueue(work, QUEUE_RECORD * before + across * across + slot, cell);
    for (int k = 0; k < 16; k++) {
        enter(work, record + k, root.v[k]);
        enter(work, record + 16 + k, slope.v[k]);
    }
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
    for (int j = j0; j < min(j0 + work.tile, work.size); j++) {
        for (int i = i0; i < min(i0 + work.tile, work.size); i++) {
            set_answer(work, j * work.size + i, word);
        }
    }
}
