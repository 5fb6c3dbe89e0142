// The quadtree over the image in OpenCL C: work items search cells, and queue the next level's cells on the device.
#define trailing_zeros(v) popcount(((v) & -(v)) - 1)  // v must be positive
typedef struct Work {
    __global real *t; __global int *answer; __global int *queue; __global int *counts;
    Camera camera; int size; int level; int last; int source; int target; int front;
} Work;

int queued(Work work, int place) {
    return work.queue[place];
}

void enqueue(Work work, int place, int value) {
    work.queue[place] = value;
}

int queue_slot(Work work, int counter) {
    return atomic_inc(&work.counts[counter]);
}

void answer_pixel(Work work, int pixel, real distance, int word) {
    work.t[pixel] = distance;
    work.answer[pixel] = word;
}

bool loops_were_ended(Work work) {
    return false;
}
