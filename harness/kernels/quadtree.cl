// The quadtree over the image as OpenCL: one cell for each work item, the next level's cells queued on the device.
typedef struct Work {
    __global const float *c; __global real *t; __global int *answer; __global int *queue; __global int *counts;
    int size; int level; int last; int source; int target;
} Work;

Camera work_camera(Work work) {
    __global const float *c = work.c;
    Camera camera;
    camera.eye = vec3(c[0], c[1], c[2]);
    camera.forward = vec3(c[3], c[4], c[5]);
    camera.right = vec3(c[6], c[7], c[8]);
    camera.up = vec3(c[9], c[10], c[11]);
    return camera;
}

int queued(Work work, int place) {
    return work.queue[place];
}

void enqueue(Work work, int place, int value) {
    work.queue[place] = value;
}

int queue_slot(Work work) {
    return atomic_inc(&work.counts[work.level]);
}

void answer_hit(Work work, int pixel, real distance, int packed) {
    work.t[pixel] = distance;
    work.answer[pixel] = packed;
}

void answer_miss(Work work, int pixel, int packed) {
    work.answer[pixel] = packed;
}
