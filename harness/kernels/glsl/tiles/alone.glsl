// What stages of isolation by ranges write where a work item has a tile, or a pixel, to itself.
// Answers that all pixels of a tile miss.
void answer_empty(Work work, int i0, int j0, int evaluations) {
    int word = answer_word(MISS, work.level, evaluations);
    for (int j = j0; j < min(j0 + work.tile, work.size); j++) {
        for (int i = i0; i < min(i0 + work.tile, work.size); i++) {
            set_answer(work, j * work.size + i, word);
        }
    }
}

// Puts a pixel on the list of those that the last stage casts, from a depth on.
void leave_pixel(Work work, int place, real from) {
    int before = tiles_before(work.size, TILE >> LEVELS);
    int slot = next_in(work, LEFT);
    enqueue(work, QUEUE_RECORD * before + slot, place);
    enter(work, (OPEN_RECORD + SINGLE_RECORD) * before + slot, from);
}

// Returns where the record of one more single tile begins in `entries`.
int next_single(Work work, int cell) {
    int slot = next_in(work, 4 * work.level + 1);
    int across = tiles_across(work.size, work.tile);
    enqueue(work, QUEUE_RECORD * tiles_before(work.size, work.tile) + across * across + slot, cell);
    return singles_at(work.size, work.tile) + SINGLE_RECORD * slot;
}
