// Finds the first roots of any f along the rays of a camera's pixels, by tiles: squares of pixels whose rays are
// isolated together. f and its derivatives are enclosed by intervals over the pyramid that a tile's rays fill between
// two depths. Where f excludes 0 there, no ray has a root. Where f falls or rises along all rays, and has one sign at the
// near end and the other at the far end, each ray has exactly one.
#define WIDER 0.03125     // pixels by which a tile's square is larger on each side than the middles of its pixels
#define UP 1.000244140625 // makes a bound larger by more than the rounding errors of its computation

#define SEARCHING 0
#define EMPTY 1
#define SINGLE 2
#define OPEN 3

// How far a computed point on one of the frame's rays may be from the exact one, in each coordinate, and a direction.
STRUCT(Roundings) struct Roundings { vec3 point; vec3 direction; };

Roundings roundings_of(Frame frame) {
    real reach = UP * frame.reach;
    real far = fabs(frame.middle) + reach;
    vec3 right = frame.right;
    vec3 up = frame.up;
    vec3 aside = vec3(fabs(right.x) + fabs(up.x), fabs(right.y) + fabs(up.y), fabs(right.z) + fabs(up.z));
    vec3 ahead = vec3(fabs(frame.forward.x), fabs(frame.forward.y), fabs(frame.forward.z));
    real unit = 32.0 * UNIT_ROUNDOFF;
    Roundings result;
    result.direction = vec3(unit * (ahead.x + aside.x), unit * (ahead.y + aside.y), unit * (ahead.z + aside.z));
    result.point = vec3(unit * (fabs(frame.origin.x) + far * aside.x + reach * ahead.x),
                        unit * (fabs(frame.origin.y) + far * aside.y + reach * ahead.y),
                        unit * (fabs(frame.origin.z) + far * aside.z + reach * ahead.z));
    return result;
}

// The rays of a square of pixels: at depth s they are at the middle ray's point plus s (u across + v down), u and v in
// [-1, 1].
STRUCT(Pyramid) struct Pyramid { Ray middle; vec3 across; vec3 down; Roundings off; };

// Returns the pyramid of the middles of side by side pixels, (i0, j0) the first of them, widened by WIDER.
Pyramid pyramid_of(Frame frame, int i0, int j0, int side, int size) {
    real pixels = 1.0 / real(size);
    real x = real(2 * i0 + side - size) * pixels;
    real y = real(size - 2 * j0 - side) * pixels;
    real wide_side = (real(side - 1) + 2.0 * WIDER) * pixels;
    Pyramid pyramid;
    pyramid.middle = make_ray(moved(moved(frame.origin, frame.middle * x, frame.right), frame.middle * y, frame.up),
                              moved(moved(frame.forward, x, frame.right), y, frame.up));
    pyramid.across = vec3(wide_side * frame.right.x, wide_side * frame.right.y, wide_side * frame.right.z);
    pyramid.down = vec3(-wide_side * frame.up.x, -wide_side * frame.up.y, -wide_side * frame.up.z);
    pyramid.off = roundings_of(frame);
    return pyramid;
}

STRUCT(Box) struct Box { Interval x; Interval y; Interval z; };

// Returns one coordinate of a pyramid's points between two parameters: o and d are those of its middle ray, `near` and
// `far` the largest distances from it at the two ends.
Interval piece_coordinate(real o, real d, real a, real b, real near, real far, real off) {
    real p = o + a * d;
    real q = o + b * d;
    return make_interval(min(p - near, q - far) - off, max(p + near, q + far) + off);
}

Box piece_box(Frame frame, Pyramid pyramid, real a, real b) {
    vec3 aside = vec3(fabs(pyramid.across.x) + fabs(pyramid.down.x), fabs(pyramid.across.y) + fabs(pyramid.down.y),
                      fabs(pyramid.across.z) + fabs(pyramid.down.z));
    real near = frame.middle + a;
    real far = frame.middle + b;
    Ray ray = pyramid.middle;
    Box box;
    box.x = piece_coordinate(ray.origin.x, ray.direction.x, a, b, near * aside.x, far * aside.x, pyramid.off.point.x);
    box.y = piece_coordinate(ray.origin.y, ray.direction.y, a, b, near * aside.y, far * aside.y, pyramid.off.point.y);
    box.z = piece_coordinate(ray.origin.z, ray.direction.z, a, b, near * aside.z, far * aside.z, pyramid.off.point.z);
    return box;
}

// Returns the distance of a coordinate from an interval, 0 inside it.
real gap(Interval a, real c) {
    return max(max(a.lo - c, c - a.hi), real(0));
}

// Returns whether no point of the box is in the domain.
bool outside_domain(Box box) {
    vec3 lower = DOMAIN_LOWER;
    vec3 upper = DOMAIN_UPPER;
    vec3 center = DOMAIN_CENTER;
    real x = gap(box.x, center.x);
    real y = gap(box.y, center.y);
    real z = gap(box.z, center.z);
    bool beside = box.x.lo > upper.x || box.x.hi < lower.x || box.y.lo > upper.y || box.y.hi < lower.y
                  || box.z.lo > upper.z || box.z.hi < lower.z;
    return beside || (DOMAIN_IS_BOX == 0 && x * x + y * y + z * z > UP * DOMAIN_RADIUS * DOMAIN_RADIUS);
}

// Returns whether all of the box is in the domain.
bool inside_domain(Box box) {
    vec3 lower = DOMAIN_LOWER;
    vec3 upper = DOMAIN_UPPER;
    vec3 center = DOMAIN_CENTER;
    real x = max(box.x.hi - center.x, center.x - box.x.lo);
    real y = max(box.y.hi - center.y, center.y - box.y.lo);
    real z = max(box.z.hi - center.z, center.z - box.z.lo);
    bool between = box.x.lo > lower.x && box.x.hi < upper.x && box.y.lo > lower.y && box.y.hi < upper.y
                   && box.z.lo > lower.z && box.z.hi < upper.z;
    return between && (DOMAIN_IS_BOX == 1 || UP * (x * x + y * y + z * z) < DOMAIN_RADIUS * DOMAIN_RADIUS);
}

// Returns an interval that holds the derivatives along d of f in a box.
Interval slope_along(GradientRange g, vec3 d) {
    real lo = min(g.x.lo * d.x, g.x.hi * d.x) + min(g.y.lo * d.y, g.y.hi * d.y) + min(g.z.lo * d.z, g.z.hi * d.z);
    real hi = max(g.x.lo * d.x, g.x.hi * d.x) + max(g.y.lo * d.y, g.y.hi * d.y) + max(g.z.lo * d.z, g.z.hi * d.z);
    real size = interval_magnitude(g.x) * fabs(d.x) + interval_magnitude(g.y) * fabs(d.y)
                + interval_magnitude(g.z) * fabs(d.z);
    real error = 8.0 * UNIT_ROUNDOFF * size + REAL_TINY;
    return make_interval(lo - error, hi + error);
}

// Returns an interval that holds f at the middle ray's point, as it is computed.
Interval middle_range(Pyramid pyramid, real a) {
    vec3 p = ray_point(pyramid.middle, a);
    return surface_range(make_interval(p.x, p.x), make_interval(p.y, p.y), make_interval(p.z, p.z));
}

// What the search of a pyramid ends with. SINGLE: each ray has its first root between start and stop, and no other one
// there; f is of the sign `sign` (1 or -1) at start. OPEN: no ray has a root before start, and pieces of this width were
// not decided. `slope`, `across` and `down` are middles of f's derivatives: along the middle ray and, at depth 1, aside.
STRUCT(Search) struct Search {
    int verdict; real start; real stop; real sign; real slope; real across; real down; bool whole; int evaluations;
};

// Searches a pyramid's pieces from `start` to `end`, the first one `width` long. A piece that is not decided is halved
// until it is no longer than `least`. Where f falls or rises along all rays, and the far end is not behind all their
// roots, the piece is made longer instead. A pyramid with more than one ray is single only if all have entered the domain
// where the first of them may have its root.
Search searched(Frame frame, Pyramid pyramid, real start, real end, real width, real least, bool alone) {
    Search search;
    search.verdict = start < end ? SEARCHING : EMPTY;
    search.start = start;
    search.stop = end;
    search.sign = 0.0;
    search.slope = 1.0;
    search.across = 0.0;
    search.down = 0.0;
    search.whole = false;
    search.evaluations = 0;
    real before = 0.0;  // f's sign at the near end for all rays, 0 if it is not known
    int grown = 0;
    Interval first = middle_range(pyramid, start);
    while (search.verdict == SEARCHING) {
        bool most = search.evaluations >= 2 * PIECES;
        real a = search.start;
        real b = grown > 0 ? a + width : min(a + width, end);
        Box box = piece_box(frame, pyramid, a, b);
        GradientRange g = surface_gradient_range(box.x, box.y, box.z);
        Interval last = middle_range(pyramid, b);
        search.evaluations += 2;
        Interval along = slope_along(g, pyramid.middle.direction);
        Interval across = slope_along(g, pyramid.across);
        Interval down = slope_along(g, pyramid.down);
        real sizes = interval_magnitude(across) + interval_magnitude(down);
        // how much f at a ray's point may differ from that at the middle ray's, and its slope from the middle ray's
        real aside = UP * ((frame.middle + b) * sizes + interval_magnitude(g.x) * pyramid.off.point.x
                           + interval_magnitude(g.y) * pyramid.off.point.y + interval_magnitude(g.z) * pyramid.off.point.z);
        real turned = UP * (sizes + interval_magnitude(g.x) * pyramid.off.direction.x + interval_magnitude(g.y) * pyramid.off.direction.y
                            + interval_magnitude(g.z) * pyramid.off.direction.z);
        // signs are turned so that f is positive at the near end
        real side = first.lo > 0.0 ? real(1) : (first.hi < 0.0 ? real(-1) : real(0));
        if (before != 0.0) side = before;
        real near = side > 0.0 ? first.lo : -first.hi;
        real far = side > 0.0 ? last.lo : -last.hi;
        real far_most = side > 0.0 ? last.hi : -last.lo;
        real fall = side > 0.0 ? along.lo : -along.hi;
        real rise = side > 0.0 ? along.hi : -along.lo;
        // the least that f may be on the middle ray: it is above a line from each end
        real spread = rise - fall;
        real crossing = (rise * near - fall * far + fall * rise * (b - a)) / spread;
        real error = 16.0 * UNIT_ROUNDOFF * (fabs(rise * near) + fabs(fall * far) + fabs(fall * rise) * (b - a)) / spread;
        real lowest = fall >= 0.0 ? near : (rise <= 0.0 ? far : crossing - error);
        bool sure = side != 0.0 && (before != 0.0 || near > aside);
        bool rises = g.known && sure && fall > turned;
        bool falls = g.known && sure && rise < -turned;
        bool clear = g.value.lo > 0.0 || g.value.hi < 0.0;
        bool empty = outside_domain(box) || clear || rises || (g.known && side != 0.0 && lowest > aside);
        real steepest = -fall + turned;
        real flattest = -rise - turned;
        bool crosses = far_most < -aside;
        // no ray has a root before this, and if it has entered the domain there, none that is before its way in it
        real before_roots = a + max(near - aside, real(0)) / (UP * steepest);
        bool entered = alone || inside_domain(piece_box(frame, pyramid, before_roots, before_roots));
        if (empty) {
            search.start = b;
            first = last;
            before = 0.0;
            if (g.known && clear) before = g.value.lo > 0.0 ? real(1) : real(-1);
            if (g.known && !clear && (rises || lowest > aside)) before = side;
            if (grown == 0) width = 2.0 * width;
            grown = 0;
            if (b >= end) search.verdict = EMPTY;
        } else if (falls && crosses && entered) {
            search.verdict = SINGLE;
            search.stop = b;
            search.sign = side;
            search.slope = 0.5 * (along.lo + along.hi);
            search.across = 0.5 * (across.lo + across.hi);
            search.down = 0.5 * (down.lo + down.hi);
            search.whole = inside_domain(piece_box(frame, pyramid, before_roots, b));
        } else if (falls && !crosses && grown < GROWTHS && !most) {
            grown += 1;
            width = min((b - a) + 1.0625 * (max(far_most, real(0)) + 2.0 * aside) / flattest, 4.0 * width);
        } else if (grown > 0 || width <= least || most) {
            search.verdict = OPEN;
            search.stop = b;
        } else {
            width = 0.5 * width;
        }
    }
    return search;
}

// Returns the part of a pyramid's parameters at which one of its rays may be in the domain; empty if lo > hi.
Span span_of(Frame frame, Pyramid pyramid) {
    vec3 sum = moved(pyramid.across, 1.0, pyramid.down);
    vec3 rest = difference(pyramid.across, pyramid.down);
    real corner = sqrt(max(inner_product(sum, sum), inner_product(rest, rest)));
    real aside = UP * UP * frame.far * corner + pyramid.off.point.x + pyramid.off.point.y + pyramid.off.point.z;
    WideVec3 o;
    o.x = pyramid.middle.origin.x;
    o.y = pyramid.middle.origin.y;
    o.z = pyramid.middle.origin.z;
    WideVec3 d;
    d.x = pyramid.middle.direction.x;
    d.y = pyramid.middle.direction.y;
    d.z = pyramid.middle.direction.z;
    WideSpan span = wide_span(o, d, aside);
    return make_span(max(span.lo, -frame.middle), span.hi);
}

// A pixel's own ray o + t d, whose origin is nearest to the domain's centre; the parameter p of a pyramid is reached at
// t = base + p length.
STRUCT(OwnRay) struct OwnRay { Ray ray; real shift; real base; real length; };

OwnRay own_ray(Work work, Frame frame, int i, int j) {
    Ray ray = pixel_ray(work, i, j);
    OwnRay result;
    result.shift = inner_product(difference(DOMAIN_CENTER, ray.origin), ray.direction);
    result.ray = advanced_ray(ray, result.shift);
    result.length = 1.0 / inner_product(ray.direction, frame.normal);
    result.base = inner_product(difference(frame.origin, result.ray.origin), frame.normal) * result.length;
    return result;
}

// The root of f between a and b, where f has the sign `sign` before it and the other one behind it. `good`: the last
// step is no longer than the tolerance.
STRUCT(Refined) struct Refined { real t; bool good; int evaluations; };

// Refines it from t on, by secants that stay in the bracket. `g` is the inverse of f's slope.
Refined refined(Ray ray, real sign, real from, real a, real b, real g) {
    real tolerance = max(STEP, 4.0 * UNIT_ROUNDOFF) * (2.0 * DOMAIN_RADIUS);
    real lo = a;
    real hi = b;
    real t = clamp(from, a, b);
    real f = surface_value(ray_point(ray, t));
    real step = b - a;
    int evaluations = 1;
    for (int k = 0; k < STEPS && fabs(step) > tolerance; k++) {
        bool behind = f * sign < 0.0;
        hi = behind ? t : hi;
        lo = behind ? lo : t;
        real next = t - f * g;
        if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
        step = next - t;
        real f1 = surface_value(ray_point(ray, next));
        real secant = step / (f1 - f);
        if (fabs(step) > 32.0 * UNIT_ROUNDOFF * DOMAIN_RADIUS && secant * sign < 0.0) g = secant;
        t = next;
        f = f1;
        evaluations += 1;
    }
    Refined result;
    real last = t - f * g;
    result.t = last >= lo && last <= hi ? last : t;
    result.good = fabs(step) <= tolerance;
    result.evaluations = evaluations;
    return result;
}

// Answers a pixel whose ray has its first root between the parameters start and stop, about at `root`. `whole`: the root
// is in the domain. Otherwise it may lie beside it, and the pixel may be left to the last stage.
void finish_pixel(Work work, Frame frame, int i, int j, real sign, real root, real slope, real start, real stop,
                  bool whole, int stage, int spent) {
    OwnRay own = own_ray(work, frame, i, j);
    real slack = 16.0 * UNIT_ROUNDOFF * DOMAIN_RADIUS;
    Refined found = refined(own.ray, sign, own.base + root * own.length, own.base + start * own.length - slack,
                            own.base + stop * own.length + slack, own.length / slope);
    bool hit = true;
    bool left = !found.good;
    if (!whole) {
        Span span = domain_span(own.ray);
        hit = span.lo <= span.hi && found.t <= span.hi;
        left = hit && (left || found.t < max(span.lo, -own.shift));
    }
    int place = j * work.size + i;
    answer_pixel(work, place, own.shift, found.t, answer_word(hit ? HIT : MISS, stage, spent + found.evaluations));
    if (left) leave_pixel(work, place, start);
}

// Lists a single tile with the root of its middle ray, and how that changes towards the tile's sides.
void list_ranged(Work work, Frame frame, int cell, Search search, Pyramid pyramid, int spent) {
    Refined found = refined(pyramid.middle, search.sign, 0.5 * (search.start + search.stop), search.start, search.stop,
                            1.0 / search.slope);
    real leaning = -(frame.middle + found.t) / search.slope;
    int record = new_single(work, cell);
    enter(work, record, found.t);
    enter(work, record + 1, leaning * search.across);
    enter(work, record + 2, leaning * search.down);
    enter(work, record + 3, search.slope);
    enter(work, record + 4, search.start);
    enter(work, record + 5, search.stop);
    enter(work, record + 6, search.sign);
    enter(work, record + 7, search.whole ? real(1) : real(0));
    enter(work, record + 8, real(spent));
}

// Stage 1. Tiles of one level: each is empty, single or open. Open ones are cut into quarters on the next level, and
// those of the last level into pixels by stage 3.
void isolate_tiles(Work work, Frame frame) {
    int across = tiles_across(work.size, work.tile);
    int total = tiles_to_take(work);
    int pixels = work.tile * work.tile;
    for (int number = work.item; number < total; number += work.items) {
        Taken taken = taken_tile(work, number);
        if (taken.x >= across || taken.y >= across) continue;
        bool first = taken.record < 0;
        real start = first ? -REAL_INFINITY : entry_at(work, taken.record);
        real width = first ? REAL_INFINITY : entry_at(work, taken.record + 1);
        int spent = first ? 0 : int(entry_at(work, taken.record + 2));
        int cell = taken.y * across + taken.x;
        int i0 = taken.x * work.tile;
        int j0 = taken.y * work.tile;
        Pyramid pyramid = pyramid_of(frame, i0, j0, work.tile, work.size);
        Span span = span_of(frame, pyramid);
        start = max(start, span.lo);
        width = min(width, FIRST * (span.hi - span.lo));
        real least = SHORTEST * real(work.tile) * frame.pixel * frame.far;
        Search search = searched(frame, pyramid, start, span.hi, width, least, false);
        spent += search.evaluations;
        int share = (spent + pixels - 1) / pixels;
        if (search.verdict == EMPTY) answer_empty(work, i0, j0, share);
        if (search.verdict == SINGLE) list_ranged(work, frame, cell, search, pyramid, share);
        if (search.verdict == OPEN) {
            list_open(work, cell, search.start, 2.0 * (search.stop - search.start), spent / 4);
        }
    }
}

// Stage 2. Pixels of single tiles.
void finish_tiles(Work work, Frame frame) {
    int across = tiles_across(work.size, work.tile);
    int pixels = work.tile * work.tile;
    int total = pixels * counted(work, 4 * work.level + 1);
    int list = QUEUE_RECORD * tiles_before(work.size, work.tile) + across * across;
    real half_side = 0.5 * real(work.tile - 1) + WIDER;
    for (int item = TILE_ITEMS * work.item + work.lane; item < total; item += TILE_ITEMS * work.items) {
        int slot = item / pixels;
        int cell = queued(work, list + slot);
        int record = singles_at(work.size, work.tile) + SINGLE_RECORD * slot;
        int bi = item % work.tile;
        int bj = (item % pixels) / work.tile;
        int i = (cell % across) * work.tile + bi;
        int j = (cell / across) * work.tile + bj;
        if (i >= work.size || j >= work.size) continue;
        real u = (real(bi) - 0.5 * real(work.tile - 1)) / half_side;
        real v = (real(bj) - 0.5 * real(work.tile - 1)) / half_side;
        real root = entry_at(work, record) + u * entry_at(work, record + 1) + v * entry_at(work, record + 2);
        finish_pixel(work, frame, i, j, entry_at(work, record + 6), root, entry_at(work, record + 3),
                     entry_at(work, record + 4), entry_at(work, record + 5), entry_at(work, record + 7) > 0.0,
                     LEVELS + work.level, int(entry_at(work, record + 8)));
    }
}

// Stage 3. Pixels of open tiles, each searched as a tile of its own.
void cast_packets(Work work, Frame frame) {
    int across = tiles_across(work.size, work.tile);
    int list = tiles_before(work.size, work.tile);
    int pixels = work.tile * work.tile;
    int total = pixels * counted(work, 4 * (work.level - 1));
    for (int item = TILE_ITEMS * work.item + work.lane; item < total; item += TILE_ITEMS * work.items) {
        int slot = item / pixels;
        int cell = queued(work, QUEUE_RECORD * list + slot);
        int record = (OPEN_RECORD + SINGLE_RECORD) * list + OPEN_RECORD * slot;
        int i = (cell % across) * work.tile + item % work.tile;
        int j = (cell / across) * work.tile + (item % pixels) / work.tile;
        if (i >= work.size || j >= work.size) continue;
        Pyramid pyramid = pyramid_of(frame, i, j, 1, work.size);
        Span span = span_of(frame, pyramid);
        real start = max(entry_at(work, record), span.lo);
        Search search = searched(frame, pyramid, start, span.hi, entry_at(work, record + 1), FINEST * DOMAIN_RADIUS, true);
        int spent = search.evaluations + int(entry_at(work, record + 2)) / (pixels / 4);
        int place = j * work.size + i;
        if (search.verdict == SINGLE) {
            real root = 0.5 * (search.start + search.stop);
            finish_pixel(work, frame, i, j, search.sign, root, search.slope, search.start, search.stop, search.whole,
                         2 * LEVELS, spent);
        } else {
            answer_pixel(work, place, 0.0, 0.0, answer_word(MISS, 2 * LEVELS, spent));
            if (search.verdict == OPEN) leave_pixel(work, place, search.start);
        }
    }
}
