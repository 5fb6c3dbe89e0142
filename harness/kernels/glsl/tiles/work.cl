// The buffers that all stages share, and where lists lie in them.
#define LEFT 49           // places in `counts`: how many pixels are left for the last stage
#define TAKEN 32          // and how many tiles of a level have been taken by isolate, by finish (8 later), by packets
typedef struct Work {
    __global const float *camera; __global real *t; __global int *answer; __global int *queue; __global int *counts;
    __global real *entries; __global const real *fourths; __global const float *rays;
    int size; int tile; int level; int ratio;
} Work;

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

int counted(Work work, int counter) {
    return work.counts[counter];
}

int queued(Work work, int place) {
    return work.queue[place];
}

real entry_at(Work work, int place) {
    return work.entries[place];
}

real fourth_at(Work work, int cell) {
    return work.fourths[cell];
}

void set_entry(Work work, int place, real value) {
    work.entries[place] = value;
}

// Returns where the contracted bounds lie in `entries`: behind the pixels that are left.
int bounds_at(Work work) {
    return (OPEN_RECORD + SINGLE_RECORD) * tiles_before(work.size, TILE >> LEVELS) + work.size * work.size;
}

int next_in(Work work, int counter) {
    return atomic_inc(&work.counts[counter]);
}

void add_to(Work work, int counter, int value) {
    atomic_add(&work.counts[counter], value);
}

void list_open(Work work, int cell, real start, real stop, int spent) {
    int slot = next_in(work, 4 * work.level);
    int before = tiles_before(work.size, work.tile);
    __global real *record = work.entries + (OPEN_RECORD + SINGLE_RECORD) * before + OPEN_RECORD * slot;
    work.queue[QUEUE_RECORD * before + slot] = cell;
    record[0] = start;
    record[1] = stop;
    record[2] = real(spent);
}

// Answers that all pixels of a tile miss.
void answer_empty(Work work, int i0, int j0, int evaluations) {
    int word = answer_word(MISS, work.level, evaluations);
    for (int j = j0; j < min(j0 + work.tile, work.size); j++) {
        for (int i = i0; i < min(i0 + work.tile, work.size); i++) {
            work.answer[j * work.size + i] = word;
        }
    }
}

// Returns the vector whose inner product with p - eye is the depth of a point p: s at eye + s (forward + x right + y up).
vec3 depth_normal(vec3 forward, vec3 right, vec3 up) {
    vec3 n = vec3(right.y * up.z - right.z * up.y, right.z * up.x - right.x * up.z, right.x * up.y - right.y * up.x);
    real scale = 1.0 / inner_product(forward, n);
    return vec3(scale * n.x, scale * n.y, scale * n.z);
}
