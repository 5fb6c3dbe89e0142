// Casts the pixels that stages 2 and 3 left, each from the depth on that they reached.
void cast_left(Work work, vec3 eye, vec3 forward, vec3 right, vec3 up) {
    vec3 normal = depth_normal(forward, right, up);
    real middle = inner_product(difference(DOMAIN_CENTER, eye), normal);
    int before = tiles_before(work.size, TILE >> LEVELS);
    int total = counted(work, LEFT);
    for (int item = work.item; item < total; item += work.items) {
        int place = queued(work, QUEUE_RECORD * before + item);
        int i = place % work.size;
        int j = place / work.size;
        Ray ray = camera_ray(eye, forward, right, up, i, j, work.size, work.size);
        int listed = LISTED == 1 ? listed_place(work, i, j) : -1;
        if (listed >= 0) {
            ray = make_ray(vec3(ray_at(work, listed), ray_at(work, listed + 1), ray_at(work, listed + 2)),
                           vec3(ray_at(work, listed + 3), ray_at(work, listed + 4), ray_at(work, listed + 5)));
        }
        real depth = middle + entry_at(work, (OPEN_RECORD + SINGLE_RECORD) * before + item);
        real lower = depth / inner_product(ray.direction, normal);
        lower = max(lower - 8.0 * UNIT_ROUNDOFF * fabs(lower), real(0));
        Cast result = cast_ray_between(ray, lower, REAL_INFINITY);
        int evaluations = result.hit.evaluations + (answered(work, place) >> 7);
        answer_pixel(work, place, result.shift, result.hit.t, answer_word(result.hit.status, 2 * LEVELS + 1, evaluations));
    }
}
