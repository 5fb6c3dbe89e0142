// The camera. A ray's parameter is its depth, or what the depth exceeds `middle` by: at depth s, the ray of the place
// (x, y) is at eye + s (forward + x right + y up) = origin + middle (x right + y up) + (s - middle) (forward + x right +
// y up).
STRUCT(Frame) struct Frame {
    vec3 eye; vec3 forward; vec3 right; vec3 up;
    vec3 normal;     // the depth of a point p is the inner product of p - eye and this
    vec3 origin;     // the point at depth `middle` on the camera's axis
    real middle;     // the depth of the domain's centre
    real reach;      // how far depths in the domain are from it at most
    real far;        // the largest depth in the domain
    real pixel;      // the larger side of a pixel at depth 1
};

Frame make_frame(Work work) {
    Frame frame;
    frame.eye = camera_vector(work, 0);
    frame.forward = camera_vector(work, 3);
    frame.right = camera_vector(work, 6);
    frame.up = camera_vector(work, 9);
    frame.normal = depth_normal(frame.forward, frame.right, frame.up);
    frame.middle = inner_product(difference(DOMAIN_CENTER, frame.eye), frame.normal);
    frame.origin = advanced_ray(make_ray(frame.eye, frame.forward), frame.middle).origin;
    frame.reach = DOMAIN_RADIUS * sqrt(inner_product(frame.normal, frame.normal));
    frame.far = frame.middle + frame.reach;
    real squared_right = inner_product(frame.right, frame.right);
    real squared_up = inner_product(frame.up, frame.up);
    frame.pixel = 2.0 * sqrt(max(squared_right, squared_up)) / real(work.size);
    return frame;
}

// A tile that is to be searched: its place among the level's tiles, and where the record of the open tile that it is a
// quarter of begins in `entries`; -1 on the first level.
STRUCT(Taken) struct Taken { int x; int y; int record; };

// Returns how many tiles are to be searched on a level: all, or the quarters of the open tiles of the level above.
int tiles_to_take(Work work) {
    int across = tiles_across(work.size, work.tile);
    return work.level == 0 ? across * across : 4 * counted(work, 4 * (work.level - 1));
}

Taken taken_tile(Work work, int number) {
    int across = tiles_across(work.size, work.tile);
    Taken taken;
    taken.x = number % across;
    taken.y = number / across;
    taken.record = -1;
    if (work.level > 0) {
        int above_across = tiles_across(work.size, 2 * work.tile);
        int above = tiles_before(work.size, 2 * work.tile);
        int parent = queued(work, QUEUE_RECORD * above + (number >> 2));
        taken.x = 2 * (parent % above_across) + (number & 1);
        taken.y = 2 * (parent / above_across) + ((number >> 1) & 1);
        taken.record = (OPEN_RECORD + SINGLE_RECORD) * above + OPEN_RECORD * (number >> 2);
    }
    return taken;
}
