// Writes what the check reads of each pixel; row 0 is at the bottom. Every pixel gives its ray in world coordinates.
// All its fragments together, drawn or not, give how many they are, the evaluations they spent, and how many of them
// hit, gave up or gave no answer. The fragment that is seen gives its local ray, t in two parts, and its instance.
layout(location = 1) out vec4 seen_origin;
layout(location = 2) out vec4 seen_direction;
layout(location = 3) out vec4 seen_by;
layout(std430, binding = 1) buffer Rays { float rays[]; };
layout(std430, binding = 2) buffer Counts { int counts[]; };
uniform int batch;

void report_ray(vec3 origin, vec3 direction) {
    int pixel = int(gl_FragCoord.y) * size + int(gl_FragCoord.x);
    rays[6 * pixel] = origin.x;
    rays[6 * pixel + 1] = origin.y;
    rays[6 * pixel + 2] = origin.z;
    rays[6 * pixel + 3] = direction.x;
    rays[6 * pixel + 4] = direction.y;
    rays[6 * pixel + 5] = direction.z;
}

void report_fragment(Ray world, int evaluations, int status) {
    int pixel = int(gl_FragCoord.y) * size + int(gl_FragCoord.x);
    report_ray(world.origin, world.direction);
    atomicAdd(counts[5 * pixel], 1);
    if (!is_answer(status, evaluations)) {
        atomicAdd(counts[5 * pixel + 4], 1);
        return;
    }
    atomicAdd(counts[5 * pixel + 1], evaluations);
    if (status == HIT) atomicAdd(counts[5 * pixel + 2], 1);
    if (status == EXHAUSTED) atomicAdd(counts[5 * pixel + 3], 1);
}

void report_seen(Ray ray, float shift, float t, int who, bool in_world) {
    seen_origin = vec4(ray.origin, shift);
    seen_direction = vec4(ray.direction, t);
    seen_by = vec4(1.0, float(batch), float(who), in_world ? 1.0 : 0.0);
}
