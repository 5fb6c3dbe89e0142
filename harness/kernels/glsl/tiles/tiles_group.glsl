// What isolation writes for a tile where sixteen work items have one lane each.
int new_single(Work work, int cell) {
    return single_record(work, cell, shared_place(work, 4 * work.level + 1));
}

void enter_single(Work work, int place, real root, real slope, real start, real stop, bool whole, real lean_x,
                  real lean_y) {
    enter(work, place + OWN_LANE, root);
    enter(work, place + 16 + OWN_LANE, slope);
    enter_piece(work, place + 32, start, stop, whole, lean_x, lean_y);
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
