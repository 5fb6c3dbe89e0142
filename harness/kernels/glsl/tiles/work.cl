// The buffers that all stages share, and which work item takes what.
#define LEFT 49           // places in `counts`: how many pixels are left for the last stage
#define TAKEN 32          // and how many tiles of a level have been taken by isolate, by finish (8 later), by packets
#define bit_count(v) popcount(v)

// Where sixteen work items share a tile, `lane` is the one that this one has. Where tiles are not taken from a counter,
// `item` is which of the `items` that take tiles it is, or its group. `numbers` and `bits`: what its group shares.
// `taken`: the next of the tiles that it took last, of which it has `left` to do.
typedef struct Work {
    __global const float *camera; __global real *t; __global int *answer; __global int *queue; __global int *counts;
    __global real *entries; __global const real *fourths; __global const float *rays;
    int size; int tile; int level; int ratio; int lane; int item; int items; __local real *numbers; __local int *bits;
    int taken; int left;
} Work;

// What the kernel of a stage takes, and what it hands on; TILE_ITEMS work items share a tile or a pixel.
#define TAKES __global const float *camera, __global real *t, __global int *answer, __global int *queue, \
              __global int *counts, __global real *entries, __global const real *fourths, __global const float *rays, \
              int nx, int ny, int size, int tile, int level, int ratio
#define WORK {camera, t, answer, queue, counts, entries, fourths, rays, size, tile, level, ratio, \
              (int)get_global_id(0) % 16, (int)get_global_id(0) / TILE_ITEMS, (int)get_global_size(0) / TILE_ITEMS, \
              numbers, bits, 0, 0}

real camera_at(Work work, int place) { return work.camera[place]; }
int counted(Work work, int counter) { return work.counts[counter]; }
int queued(Work work, int place) { return work.queue[place]; }
real entry_at(Work work, int place) { return work.entries[place]; }
real fourth_at(Work work, int cell) { return work.fourths[cell]; }
real ray_at(Work work, int place) { return work.rays[place]; }
int next_in(Work work, int counter) { return atomic_inc(&work.counts[counter]); }
void add_to(Work work, int counter, int value) { atomic_add(&work.counts[counter], value); }
void enqueue(Work work, int place, int value) { work.queue[place] = value; }
void enter(Work work, int place, real value) { work.entries[place] = value; }
void set_t(Work work, int place, real value) { work.t[place] = value; }
void set_answer(Work work, int place, int word) { work.answer[place] = word; }
int answered(Work work, int place) { return work.answer[place]; }

// Gives `count` neighbouring pixels of a row the same answer.
void set_answers(Work work, int place, int count, int word) {
    int k = 0;
    for (; k + 8 <= count; k += 8) vstore8((int8)(word), 0, work.answer + place + k);
    for (; k < count; k++) work.answer[place + k] = word;
}

#ifndef RESERVED
#define RESERVED __local real *numbers = 0; __local int *bits = 0;
#endif
