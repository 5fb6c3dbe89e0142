// What stages write where a work item has a tile to itself.
// Answers that all pixels of a tile miss.
void answer_empty(Work work, int i0, int j0, int evaluations) {
    int word = answer_word(MISS, work.level, evaluations);
    int width = min(work.tile, work.size - i0);
    for (int j = j0; j < min(j0 + work.tile, work.size); j++) set_answers(work, j * work.size + i0, width, word);
}

// Lists one more single tile, and returns where its record begins in `entries`.
int new_single(Work work, int cell) {
    return single_record(work, cell, next_in(work, 4 * work.level + 1));
}
