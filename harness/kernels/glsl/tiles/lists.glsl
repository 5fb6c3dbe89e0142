// Where lists lie in the buffers, and what is written there for one tile or pixel.
// Packs a pixel's status, evaluations, and the stage that answered it: a level's number where its tile is empty, LEVELS
// more where it is single, 2 LEVELS for packets and one more for the rest.
int answer_word(int status, int stage, int evaluations) {
    return is_answer(status, evaluations) ? (evaluations * 32 + stage) * 4 + status : NO_ANSWER;
}

// Returns where the listed ray of a pixel begins in `rays`: that of each `ratio`th row and column; -1 if it has none.
int listed_place(Work work, int i, int j) {
    int ratio = work.ratio;
    bool grid = i < work.size && j < work.size && i % ratio == (ratio - 1) / 2 && j % ratio == (ratio - 1) / 2;
    return grid ? 6 * ((j / ratio) * (work.size / ratio) + i / ratio) : -1;
}

int tiles_across(int size, int tile) {
    return (size + tile - 1) / tile;
}

// Returns how many tiles the levels have whose tiles are larger than `tile`.
int tiles_before(int size, int tile) {
    int count = 0;
    for (int side = TILE; side > tile; side /= 2) count += tiles_across(size, side) * tiles_across(size, side);
    return count;
}

// Returns where the records of a level's single tiles begin in `entries`. Those of its open tiles come before.
int singles_at(int size, int tile) {
    int across = tiles_across(size, tile);
    return (OPEN_RECORD + SINGLE_RECORD) * tiles_before(size, tile) + OPEN_RECORD * across * across;
}

// Puts a tile on its level's list of open ones.
void list_open(Work work, int cell, real start, real stop, int spent) {
    int slot = next_in(work, 4 * work.level);
    int before = tiles_before(work.size, work.tile);
    int record = (OPEN_RECORD + SINGLE_RECORD) * before + OPEN_RECORD * slot;
    enqueue(work, QUEUE_RECORD * before + slot, cell);
    enter(work, record, start);
    enter(work, record + 1, stop);
    enter(work, record + 2, real(spent));
}

// Answers one pixel, which hits at shift + t or misses. A check keeps t in two parts, and so its last bits.
void answer_pixel(Work work, int place, real shift, real t, int word) {
    set_answer(work, place, word);
    if (LISTED == 0) {
        set_t(work, place, shift + t);
    } else {
        set_t(work, 2 * place, shift);
        set_t(work, 2 * place + 1, t);
    }
}

// Returns the vector whose inner product with p - eye is the depth of a point p: s at eye + s (forward + x right + y up).
vec3 depth_normal(vec3 forward, vec3 right, vec3 up) {
    vec3 n = vec3(right.y * up.z - right.z * up.y, right.z * up.x - right.x * up.z, right.x * up.y - right.y * up.x);
    real scale = 1.0 / inner_product(forward, n);
    return vec3(scale * n.x, scale * n.y, scale * n.z);
}
