// Casts the pixels that stages 2 and 3 left, each from the depth on that they reached; level is the number of levels.
__kernel void rest(__global const float *camera, __global real *t, __global int *answer, __global int *queue,
                   __global int *counts, __global real *entries, __global const real *fourths,
                   __global const float *rays, int nx, int ny, int size, int tile, int level, int ratio) {
    Work work = {camera, t, answer, queue, counts, entries, fourths, rays, size, tile, level, ratio};
    vec3 eye = vec3(camera[0], camera[1], camera[2]);
    vec3 forward = vec3(camera[3], camera[4], camera[5]);
    vec3 right = vec3(camera[6], camera[7], camera[8]);
    vec3 up = vec3(camera[9], camera[10], camera[11]);
    vec3 normal = depth_normal(forward, right, up);
    real middle = inner_product(difference(DOMAIN_CENTER, eye), normal);
    int before = tiles_before(size, TILE >> LEVELS);
    for (int item = get_global_id(0); item < counts[LEFT]; item += nx) {
        int place = queue[QUEUE_RECORD * before + item];
        int i = place % size;
        int j = place / size;
        Ray ray = camera_ray(eye, forward, right, up, i, j, size, size);
        int listed = LISTED == 1 ? listed_place(work, i, j) : -1;
        if (listed >= 0) {
            __global const float *given = rays + listed;
            ray = make_ray(vec3(given[0], given[1], given[2]), vec3(given[3], given[4], given[5]));
        }
        real depth = middle + entries[(OPEN_RECORD + SINGLE_RECORD) * before + item];
        real lower = depth / inner_product(ray.direction, normal);
        lower = max(lower - 8.0 * UNIT_ROUNDOFF * fabs(lower), real(0));
        Cast result = cast_ray_between(ray, lower, REAL_INFINITY);
        result.hit.evaluations += answer[place] >> 7;
        if (LISTED == 1) {
            t[2 * place] = result.shift;
            t[2 * place + 1] = result.hit.t;
        } else {
            t[place] = result.shift + result.hit.t;
        }
        answer[place] = answer_word(result.hit.status, 2 * LEVELS + 1, result.hit.evaluations);
    }
}
