// Where lists lie in the buffers, and what is written there for one tile or pixel.
// Packs a pixel's status, evaluations, and the stage that answered it: a level's number where its tile is empty, LEVELS
// more where it is single, 2 LEVELS for packets and one more for the rest.
int answer_word(int status, int stage, int evaluations) {
    return is_answer(status, evaluations) ? (evaluations * 32 + stage) * 4 + status : NO_ANSWER;
}

// The stage that a pixel's answer names while its first root in the domain is still to be found in a second piece.
#define PASSED (2 * LEVELS + 2)

bool is_passed(int word) {
    return ((word >> 2) & 31) == PASSED;
}

int passed_word(int word) {
    return (word & ~(31 << 2)) + 4 * PASSED;
}

// Returns where the listed ray of a pixel begins in `rays`: that of each `ratio`th row and column; -1 if it has none.
int listed_place(Work work, int i, int j) {
    int ratio = work.ratio;
    bool grid = i < work.size && j < work.size && i % ratio == (ratio - 1) / 2 && j % ratio == (ratio - 1) / 2;
    return grid ? 6 * ((j / ratio) * (work.size / ratio) + i / ratio) : -1;
}

vec3 camera_vector(Work work, int place) {
    return vec3(camera_at(work, place), camera_at(work, place + 1), camera_at(work, place + 2));
}

// Returns the ray of a pixel: the listed one, where it has one.
Ray pixel_ray(Work work, int i, int j) {
    int listed = LISTED == 1 ? listed_place(work, i, j) : -1;
    if (listed >= 0) {
        return make_ray(vec3(ray_at(work, listed), ray_at(work, listed + 1), ray_at(work, listed + 2)),
                        vec3(ray_at(work, listed + 3), ray_at(work, listed + 4), ray_at(work, listed + 5)));
    }
    return camera_ray(camera_vector(work, 0), camera_vector(work, 3), camera_vector(work, 6), camera_vector(work, 9),
                      i, j, work.size, work.size);
}

int tiles_across(int size, int tile) {
    return (size + tile - 1) / tile;
}

// Returns how many tiles the levels have whose tiles are larger than `tile`.
int tiles_before(int size, int tile) {
    int count = 0;
    for (int side = TILE; side > tile; side /= 2) count += tiles_across(size, side) * tiles_across(size, side);
    return count;
}

// Returns where the records of a level's single tiles begin in `entries`. Those of its open tiles come before.
int singles_at(int size, int tile) {
    int across = tiles_across(size, tile);
    return (OPEN_RECORD + SINGLE_RECORD) * tiles_before(size, tile) + OPEN_RECORD * across * across;
}

// Puts a tile on its level's list of single ones, in the place `slot`, and returns where its record begins in `entries`.
int single_record(Work work, int cell, int slot) {
    int across = tiles_across(work.size, work.tile);
    enqueue(work, QUEUE_RECORD * tiles_before(work.size, work.tile) + across * across + slot, cell);
    return singles_at(work.size, work.tile) + SINGLE_RECORD * slot;
}

// Enters a piece that has a root of each of a single tile's rays: whether all of it is in the domain, and how its nodes'
// planes lean.
void enter_piece(Work work, int place, real start, real stop, bool whole, real lean_x, real lean_y) {
    enter(work, place, start);
    enter(work, place + 1, stop);
    enter(work, place + 2, whole ? real(1) : real(0));
    enter(work, place + 3, lean_x);
    enter(work, place + 4, lean_y);
}

// Enters what is known behind a single tile's first piece, and a pixel's share of the evaluations for the tile.
void enter_single_end(Work work, int record, int behind, int share) {
    enter(work, record + 37, real(behind));
    enter(work, record + 38, real(share));
}

// Puts a pixel in a place of the list of those that the last stage casts, from a depth on.
void leave_in(Work work, int slot, int place, real from) {
    int before = tiles_before(work.size, TILE >> LEVELS);
    enqueue(work, QUEUE_RECORD * before + slot, place);
    enter(work, (OPEN_RECORD + SINGLE_RECORD) * before + slot, from);
}

void leave_pixel(Work work, int place, real from) {
    leave_in(work, next_in(work, LEFT), place, from);
}

// Puts a tile on its level's list of open ones.
void list_open(Work work, int cell, real start, real stop, int spent) {
    int slot = next_in(work, 4 * work.level);
    int before = tiles_before(work.size, work.tile);
    int record = (OPEN_RECORD + SINGLE_RECORD) * before + OPEN_RECORD * slot;
    enqueue(work, QUEUE_RECORD * before + slot, cell);
    enter(work, record, start);
    enter(work, record + 1, stop);
    enter(work, record + 2, real(spent));
}

// Answers one pixel, which hits at shift + t or misses. A check keeps t in two parts, and so its last bits.
void answer_pixel(Work work, int place, real shift, real t, int word) {
    set_answer(work, place, word);
    if (LISTED == 0) {
        set_t(work, place, shift + t);
    } else {
        set_t(work, 2 * place, shift);
        set_t(work, 2 * place + 1, t);
    }
}

// Returns the vector whose inner product with p - eye is the depth of a point p: s at eye + s (forward + x right + y up).
vec3 depth_normal(vec3 forward, vec3 right, vec3 up) {
    vec3 n = vec3(right.y * up.z - right.z * up.y, right.z * up.x - right.x * up.z, right.x * up.y - right.y * up.x);
    real scale = 1.0 / inner_product(forward, n);
    return vec3(scale * n.x, scale * n.y, scale * n.z);
}
