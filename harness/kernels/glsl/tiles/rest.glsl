// Casts the pixels that stages 2 and 3 left, each from the depth on that they reached. If OPEN_TILES is 1, stage 3 does
// nothing, and the pixels of open tiles are cast here too.
void cast_left(Work work) {
    vec3 normal = depth_normal(camera_vector(work, 3), camera_vector(work, 6), camera_vector(work, 9));
    real middle = inner_product(difference(DOMAIN_CENTER, camera_vector(work, 0)), normal);
    int before = tiles_before(work.size, TILE >> LEVELS);
    int tile = TILE >> (LEVELS - 1);
    int last = tiles_before(work.size, tile);
    int open = OPEN_TILES == 1 ? tile * tile * counted(work, 4 * (LEVELS - 1)) : 0;
    int total = open + counted(work, LEFT);
    for (int item = work.item; item < total; item += work.items) {
        bool listed_left = item >= open;
        int slot = listed_left ? item - open : item / (tile * tile);
        int found = queued(work, QUEUE_RECORD * (listed_left ? before : last) + slot);
        int across = listed_left ? work.size : tiles_across(work.size, tile);
        int inside = listed_left ? 0 : item % (tile * tile);
        int scale = listed_left ? 1 : tile;
        int i = scale * (found % across) + inside % tile;
        int j = scale * (found / across) + inside / tile;
        if (i >= work.size || j >= work.size) continue;
        int place = j * work.size + i;
        int at = (OPEN_RECORD + SINGLE_RECORD) * (listed_left ? before : last) + (listed_left ? 1 : OPEN_RECORD) * slot;
        Ray ray = pixel_ray(work, i, j);
        real depth = middle + entry_at(work, at);
        real lower = depth / inner_product(ray.direction, normal);
        lower = max(lower - 8.0 * UNIT_ROUNDOFF * fabs(lower), real(0));
        Cast result = cast_alone(ray, lower);
        int evaluations = result.hit.evaluations + (listed_left ? answered(work, place) >> 7 : 0);
        answer_pixel(work, place, result.shift, result.hit.t, answer_word(result.hit.status, 2 * LEVELS + 1, evaluations));
    }
}
