// The quadtree over the image as GLSL: one cell for each work item, the next level's cells queued on the device.
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

struct Work { int size; int level; int last; int source; int target; };

Camera work_camera(Work work) {
    Camera camera;
    camera.eye = vec3(c[0], c[1], c[2]);
    camera.forward = vec3(c[3], c[4], c[5]);
    camera.right = vec3(c[6], c[7], c[8]);
    camera.up = vec3(c[9], c[10], c[11]);
    return camera;
}

int queued(Work work, int place) {
    return queue[place];
}

void enqueue(Work work, int place, int value) {
    queue[place] = value;
}

int queue_slot(Work work) {
    return atomicAdd(counts[work.level], 1);
}

void answer_hit(Work work, int pixel, real distance, int packed) {
    t[pixel] = distance;
    answer[pixel] = packed;
}

void answer_miss(Work work, int pixel, int packed) {
    answer[pixel] = packed;
}
