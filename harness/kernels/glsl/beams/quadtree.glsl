// The quadtree over the image in GLSL: work items search cells, and queue the next level's cells on the device.
#define trailing_zeros(v) findLSB(v)  // v must be positive
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input0 { float c[]; };
layout(std430, binding = 1) writeonly buffer Output0 { real t[]; };
layout(std430, binding = 2) writeonly buffer Output1 { int answer[]; };
layout(std430, binding = 3) buffer Scratch0 { int queue[]; };
layout(std430, binding = 4) buffer Scratch1 { int counts[]; };
uniform int nx;
uniform int ny;
uniform int size;
uniform int level;
uniform int last;
uniform int source;
uniform int target;

struct Work { Camera camera; int size; int level; int last; int source; int target; int front; };

int queued(Work work, int place) {
    return queue[place];
}

void enqueue(Work work, int place, int value) {
    queue[place] = value;
}

int queue_slot(Work work, int counter) {
    return atomicAdd(counts[counter], 1);
}

void answer_pixel(Work work, int pixel, real distance, int word) {
    t[pixel] = distance;
    answer[pixel] = word;
}

bool loops_were_ended(Work work) {
    return loops_were_ended(work.size);
}
