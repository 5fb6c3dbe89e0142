// Finds the first roots of f along the rays of a camera's pixels, by tiles: squares of pixels whose rays are isolated
// together. Along node rays, 4 by 4 in a tile, f is fitted in Bernstein form; the coefficients are interpolated by
// bicubic polynomials in Bernstein form, whose 16 control values are in the tile's lanes. A sign that all lanes have for
// certain is that of every ray of the tile.
#define N SURFACE_DEGREE
#define SHELLS 16  // sizes of the tables VALUE_ERRORS and GROWTH
#define DEPTHS 6
#define WIDER 0.03125          // pixels by which the nodes' square is larger on each side than the pixels' middles
#define RIM 0.0390625          // from the outermost nodes to the square's sides, in half sides: 5/128
#define GAP 0.3984375          // half the distance between the inner nodes: 51/128
#define BALLAST 7.0            // worst rounding error of TRANSFORM in unit roundoffs of the largest coefficient,
#define MIXING 220.0           // and of the largest difference of two lanes
#define THIRD 0.3333333432674407958984375

#define FINEST 4.0             // least tolerance of the refinement, in unit roundoffs
#define LAST_STEPS 2           // most steps by means of f
#define SHORT 0.0625           // longest last step but one, over the root of the tolerance
#define ASIDE 0.75             // most cells that a tile's rays may be from its middle ray, in one coordinate

#define SEARCHING 0
#define EMPTY 1
#define SINGLE 2
#define OPEN 3

// The camera. A ray's parameter is its depth, or what the depth exceeds `middle` by: at depth s, the ray (x, y) is at
// eye + s (forward + x right + y up) = origin + middle (x right + y up) + (s - middle) (forward + x right + y up).
STRUCT(Frame) struct Frame {
    vec3 eye; vec3 forward; vec3 right; vec3 up;
    vec3 normal;     // the depth of a point p is the inner product of p - eye and this
    vec3 origin;     // the point at depth `middle` on the camera's axis
    real middle;     // the depth of the domain's centre
    real far;        // the largest depth in the domain
    real pixel;      // the larger side of a pixel at depth 1
};

Frame make_frame(vec3 eye, vec3 forward, vec3 right, vec3 up, int size) {
    Frame frame;
    frame.eye = eye;
    frame.forward = forward;
    frame.right = right;
    frame.up = up;
    frame.normal = depth_normal(forward, right, up);
    frame.middle = inner_product(difference(DOMAIN_CENTER, eye), frame.normal);
    frame.origin = advanced_ray(make_ray(eye, forward), frame.middle).origin;
    frame.far = frame.middle + DOMAIN_RADIUS * sqrt(inner_product(frame.normal, frame.normal));
    real squared_right = inner_product(right, right);
    real squared_up = inner_product(up, up);
    frame.pixel = 2.0 * sqrt(max(squared_right, squared_up)) / real(size);
    return frame;
}

// Bounds of a fit's errors: `off` grows with a piece's depth, `noise` does not, `unit` is one halving's per degree.
STRUCT(Errors) struct Errors { real off; real noise; real unit; };

real error_at(Errors errors, int depth) {
    return GROWTH[min(depth, DEPTHS)] * errors.off + errors.noise + real(N * (depth + 1)) * errors.unit;
}

real rounding_of_samples(real away) {
    int shell = int(away * (real(SHELLS) / (REACH * DOMAIN_RADIUS)));
    return TRUST * UNIT_ROUNDOFF * TILE_ERRORS[min(shell, SHELLS - 1)];
}

// Returns each lane's square of the larger distance of two points from the domain's centre.
wide squared_distance(WideVec3 a, WideVec3 b) {
    vec3 center = DOMAIN_CENTER;
    WideVec3 p;
    WideVec3 q;
    p.x = a.x - center.x;
    p.y = a.y - center.y;
    p.z = a.z - center.z;
    q.x = b.x - center.x;
    q.y = b.y - center.y;
    q.z = b.z - center.z;
    return max(wide_inner(p, p), wide_inner(q, q));
}

// A pyramid from the eye that holds a tile's rays: at depth s it is the parallelogram of the middle ray's point plus
// s (u across + v down), u and v in [-1, 1]. Its parameter is s less frame.middle.
STRUCT(Tile) struct Tile { Ray middle; vec3 across; vec3 down; };

// Returns each lane's node ray.
WideRay node_ray(Work work, Frame frame, Tile tile) {
    wide u = lane_row(NODE_X, 0);
    wide v = lane_row(NODE_Y, 0);
    wide x = u * tile.across.x + v * tile.down.x;
    wide y = u * tile.across.y + v * tile.down.y;
    wide z = u * tile.across.z + v * tile.down.z;
    WideRay ray;
    ray.origin.x = tile.middle.origin.x + frame.middle * x;
    ray.origin.y = tile.middle.origin.y + frame.middle * y;
    ray.origin.z = tile.middle.origin.z + frame.middle * z;
    ray.direction.x = tile.middle.direction.x + x;
    ray.direction.y = tile.middle.direction.y + y;
    ray.direction.z = tile.middle.direction.z + z;
    return ray;
}

// Returns the largest distance of the tile's rays from its middle ray at depth 1, and the largest in one coordinate.
real corner_of(Tile tile) {
    vec3 sum = moved(tile.across, 1.0, tile.down);
    vec3 rest = difference(tile.across, tile.down);
    return sqrt(max(inner_product(sum, sum), inner_product(rest, rest)));
}

real widest_of(Tile tile) {
    return max(fabs(tile.across.x) + fabs(tile.down.x),
               max(fabs(tile.across.y) + fabs(tile.down.y), fabs(tile.across.z) + fabs(tile.down.z)));
}

int cell_of(real place) {
    return clamp(int(place), 0, GRID - 1);
}

// Returns |v| to each lane's power, 0 to 4.
wide power_of(wide power, real v) {
    wide result = wide(1.0);
    for (int k = 0; k < 4; k++) result = CHOOSE(MORE(power, wide(real(k))), fabs(v) * result, result);
    return result;
}

// Returns each lane's factor of a fourth derivative in the bound of the remainder at depth 1.
wide remainder_weight(Work work, Tile tile) {
    wide x = lane_row(POWERS_X, 0);
    wide y = lane_row(POWERS_Y, 0);
    wide z = lane_row(POWERS_Z, 0);
    wide across = power_of(x, tile.across.x) * power_of(y, tile.across.y) * power_of(z, tile.across.z);
    wide down = power_of(x, tile.down.x) * power_of(y, tile.down.y) * power_of(z, tile.down.z);
    return REMAINDER_X * across + REMAINDER_Y * down;
}

// Bounds the remainder of the tile's interpolation between two depths, from the bounds of fourth derivatives, one a
// lane, that are looked up along the tile's middle ray. A cell's bounds hold one cell beyond it. So if the tile's rays
// are `aside` cells from the middle one, steps of 2 (1 - aside) cells leave nothing out.
real remainder_between(Work work, Frame frame, Tile tile, Lanes weights, real aside, real start, real stop) {
    real cells = real(GRID) / (2.0 * TABLE_HALF);
    vec3 a = difference(ray_point(tile.middle, start), DOMAIN_CENTER);
    vec3 b = difference(ray_point(tile.middle, stop), DOMAIN_CENTER);
    vec3 way = difference(b, a);
    real most_way = max(fabs(way.x), max(fabs(way.y), fabs(way.z)));
    int steps = 1 + int(cells * most_way / (2.0 * (0.9990234375 - aside)));
    real share = 1.0 / real(steps);
    Lanes bounds;
    EACH_LANE {
        KEEP_NUMBER(bounds, wide(0.0))
    }
    for (int k = 0; k <= steps; k++) {
        vec3 p = moved(a, share * real(k), way);
        int z = cell_of(cells * p.z + 0.5 * real(GRID));
        int y = cell_of(cells * p.y + 0.5 * real(GRID));
        int x = cell_of(cells * p.x + 0.5 * real(GRID));
        real depth = frame.middle + min(start + share * (real(k) + 0.5) * (stop - start), stop);
        real grown = (depth * depth) * (depth * depth);
        EACH_LANE {
            RAISE_NUMBER(bounds, grown * fourth_row(work, 16 * ((z * GRID + y) * GRID + x)))
        }
    }
    real bound = 0.0;
    EACH_LANE {
        bound += total(NUMBER(weights) * NUMBER(bounds));
    }
    return bound;
}

// How a tile leans: by which share a plane of its nodes at one parameter is deeper at the tile's right side, and at its
// lower side, than in the middle. `range` is the largest distance of the nodes' roots from that plane.
STRUCT(Lean) struct Lean { real across; real down; real middle; real range; };

// Estimates the plane of the nodes' first roots from the secants of f, from [start, stop] on.
Lean lean_of(Work work, Frame frame, Tile tile, real start, real stop) {
    real width = stop - start;
    real sum = 0.0;
    real squares = 0.0;
    real across = 0.0;
    real down = 0.0;
    Lanes roots;
    EACH_LANE {
        WideRay node = node_ray(work, frame, tile);
        wide a = wide(start);
        wide t = wide(stop);
        wide fa = wide_value(wide_point(node.origin, a, node.direction));
        for (int k = 0; k < 3; k++) {
            wide f = wide_value(wide_point(node.origin, t, node.direction));
            wide next = t - f * ((t - a) / (f - fa));
            a = t;
            fa = f;
            t = clamp(CHOOSE(LESS(fabs(next), wide(REAL_INFINITY)), next, t), wide(start - 2.0 * width),
                      wide(stop + 6.0 * width));
        }
        KEEP_NUMBER(roots, t)
        sum += total(t);
        squares += total(lane_row(NODE_X, 0) * lane_row(NODE_X, 0));
        across += total(lane_row(NODE_X, 0) * t);
        down += total(lane_row(NODE_Y, 0) * t);
    }
    Lean lean;
    lean.middle = 0.0625 * sum;
    across = across / squares;
    down = down / squares;
    lean.range = 0.0;
    EACH_LANE {
        wide t = lean.middle + across * lane_row(NODE_X, 0) + down * lane_row(NODE_Y, 0);
        lean.range = max(lean.range, most(fabs(NUMBER(roots) - t)));
    }
    lean.across = across / (frame.middle + lean.middle);
    lean.down = down / (frame.middle + lean.middle);
    return lean;
}

// Returns a tile that holds the same rays, with nodes in leaning planes.
Tile leaning(Tile tile, Lean lean) {
    real grown = 1.0 / (1.0 - fabs(lean.across) - fabs(lean.down));
    Tile result;
    result.middle = tile.middle;
    result.across = moved(tile.across, lean.across, tile.middle.direction);
    result.down = moved(tile.down, lean.down, tile.middle.direction);
    result.across = vec3(grown * result.across.x, grown * result.across.y, grown * result.across.z);
    result.down = vec3(grown * result.down.x, grown * result.down.y, grown * result.down.z);
    return result;
}

int single_bits(int above, int below) {
    return bit_count(above & ~(above + 1)) + bit_count(below & ~(below + 1));
}

// Newton's method for the roots of each lane's polynomial, whose first coefficient and last differ in sign; it starts
// from the cubic of make_bracket. Returns roots and slopes.
STRUCT(WideRoot) struct WideRoot { wide x; wide slope; };

#define FIND_ROOT(found, q, looking) { \
    wide a_ = wide(0.0); \
    wide b_ = wide(1.0); \
    wide step_ = wide(1.0); \
    found.x = CHOOSE(looking, 0.5 + THIRD * ((FIRST(q) + LAST(q)) / (FIRST(q) - LAST(q))), wide(0.5)); \
    found.slope = wide(-1.0); \
    BINOMIAL(q) \
    for (int i_ = 0; i_ < 8 && any_lane(BOTH(looking, MORE(fabs(step_), wide(0.0009765625)))); i_++) { \
        wide x_ = found.x; \
        wide value_; \
        wide rise_; \
        EVALUATE(q, x_, value_, rise_) \
        yes below_ = LESS(value_, wide(0.0)); \
        b_ = CHOOSE(below_, x_, b_); \
        a_ = CHOOSE(below_, a_, x_); \
        wide next_ = x_ - value_ / rise_; \
        next_ = CHOOSE(BOTH(NOT(LESS(next_, a_)), NOT(MORE(next_, b_))), next_, 0.5 * (a_ + b_)); \
        step_ = next_ - x_; \
        found.x = next_; \
        found.slope = rise_; \
    } \
}

// Stage 1. Tiles of one level: each is empty, single (every ray has its first root in one piece, and no other root
// there), or open, and then its four quarters are searched on the next level, or its pixels by stage 3.
void isolate_tiles(Work work, Frame frame) {
    Bundle stack[HALVINGS];
    int across = tiles_across(work.size, work.tile);
    bool first = work.level == 0;
    int total = first ? across * across : 4 * counted(work, 4 * (work.level - 1));
    int above_across = tiles_across(work.size, 2 * work.tile);
    int above = tiles_before(work.size, 2 * work.tile);
    real half_side = 0.5 * real(work.tile - 1) + WIDER;
    real rounding = 64.0 * UNIT_ROUNDOFF * DOMAIN_RADIUS;
    real cells = real(GRID) / (2.0 * TABLE_HALF);
    real least_width = SHORTEST * real(work.tile) * frame.pixel * frame.far;
    Rows to_control;
    Rows to_powers;
    MAKE_ROWS(to_control, TO_CONTROL)
    MAKE_ROWS(to_powers, TO_POWERS)
    int all_fits = 0;
    int all_pieces = 0;
    for (int turn = 0;; turn++) {
        int taken = next_tile(work, TAKEN + work.level, turn);
        if (taken >= total) break;
        int cell_x = taken % across;
        int cell_y = taken / across;
        real start = -REAL_INFINITY;
        real stop = REAL_INFINITY;
        int spent = 0;
        if (!first) {
            int parent = queued(work, QUEUE_RECORD * above + (taken >> 2));
            int record = (OPEN_RECORD + SINGLE_RECORD) * above + OPEN_RECORD * (taken >> 2);
            cell_x = 2 * (parent % above_across) + (taken & 1);
            cell_y = 2 * (parent / above_across) + ((taken >> 1) & 1);
            start = entry_at(work, record);
            stop = entry_at(work, record + 1);
            spent = int(entry_at(work, record + 2));
        }
        if (cell_x >= across || cell_y >= across) continue;
        int cell = cell_y * across + cell_x;
        int i0 = cell_x * work.tile;
        int j0 = cell_y * work.tile;

        real pixels = 1.0 / real(work.size);
        real middle_x = real(2 * i0 + work.tile - work.size) * pixels;
        real middle_y = real(work.size - 2 * j0 - work.tile) * pixels;
        real side = 2.0 * half_side * pixels;
        Tile tile;
        tile.middle = make_ray(moved(moved(frame.origin, frame.middle * middle_x, frame.right),
                                     frame.middle * middle_y, frame.up),
                               moved(moved(frame.forward, middle_x, frame.right), middle_y, frame.up));
        tile.across = vec3(side * frame.right.x, side * frame.right.y, side * frame.right.z);
        tile.down = vec3(-side * frame.up.x, -side * frame.up.y, -side * frame.up.z);
        Lean lean;
        lean.across = 0.0;
        lean.down = 0.0;
        bool leans = false;
        real aside = cells * frame.far * widest_of(tile);
        real corner = 1.0009765625 * frame.far * corner_of(tile);
        real rim = RIM * corner + rounding;
        real near = REAL_INFINITY;
        real end = -REAL_INFINITY;
        Lanes weights;
        EACH_LANE {
            WideRay node = node_ray(work, frame, tile);
            // a ray is at most so far from the nearest node's ray: half a diagonal of the net
            WideSpan span = wide_span(node.origin, node.direction, GAP * corner + rounding);
            near = min(near, least(span.lo));
            end = max(end, most(span.hi));
            KEEP_NUMBER(weights, remainder_weight(work, tile))
        }
        start = max(start, max(near, -frame.middle));
        stop = min(stop, end);
        if (stop <= start) stop = end;
        int verdict = start < end ? SEARCHING : EMPTY;
        if (aside > ASIDE && verdict == SEARCHING) {
            verdict = OPEN;
            stop = end;
        }
        int depth = 0;
        int path = 1;
        int tries = 0;
        bool negative = false;
        real open_start = start;
        real open_width = 0.0;
        Poly c;
        Poly s;
        Net net;
        Bundle bundle;
        Bundle far;
        while (verdict == SEARCHING) {
            real reach = stop - start;
            bool in_table = true;
            real squared = 0.0;
            EACH_LANE {
                WideRay node = node_ray(work, frame, tile);
                WideVec3 front = wide_point(node.origin, wide(start), node.direction);
                WideVec3 back = wide_point(node.origin, wide(stop), node.direction);
                bool here = all_lanes(BOTH(inside(front, MARGIN - rim), inside(back, MARGIN - rim)));
                in_table = in_table && here;
                squared = max(squared, most(squared_distance(front, back)));
            }
            int inner = in_table ? SEARCHING : OPEN;
            depth = 0;
            path = 1;
            if (inner == SEARCHING) {
                real weighted = 0.0;
                EACH_LANE {
                    WideRay node = node_ray(work, frame, tile);
                    SAMPLE(s, node.origin, node.direction, start, reach)
                    if (FIRST_TURN) negative = first_lane_number(FIRST(s)) < 0.0;
                    if (negative) SCALE(s, -1.0)
                    FIT(s, c)
                    weighted = max(weighted, most(WEIGHTED(s)));
                    KEEP_LANE(net, c)
                }
                all_fits += 1;
                spent += 16 * (N + 1);
                real spread = 0.0;
                FIND_SPREAD(net, spread)
                CONTROL(net)
                BUNDLED(net, bundle)
                Errors errors;
                errors.unit = TRUST * UNIT_ROUNDOFF * LARGEST_IN(bundle);
                errors.off = LEBESGUE * LEBESGUE * rounding_of_samples(sqrt(squared) + rim)
                             + remainder_between(work, frame, tile, weights, aside, start, stop);
                errors.noise = TRUST * UNIT_ROUNDOFF * (2.0 * LEBESGUE * LEBESGUE * real(N / 2 + 6) * weighted
                                                        + MIXING * 2.0 * spread) + BALLAST * errors.unit;
                while (inner == SEARCHING) {
                    real error = error_at(errors, depth);
                    all_pieces += 1;
                    if (ALL_ABOVE(bundle, error)) {
                        int up = bit_count(path & ~(path + 1));  // far halves that end here, with the piece itself
                        if (up > depth) {
                            inner = EMPTY;
                        } else {
                            depth -= up;
                            path = (path >> up) + 1;
                            bundle = stack[depth - 1];
                        }
                    } else {
                        if (CROSSES(bundle, error)) {
                            bool falls = FALLS(bundle, error);
                            if (!falls) falls = single_bits(SURE_ABOVE(bundle, error), SURE_BELOW(bundle, error)) >= N;
                            if (falls) inner = SINGLE;
                        }
                        if (inner == SEARCHING && (depth == HALVINGS || reach < (leans ? 0.25 * least_width : least_width) * real(1 << depth))) inner = OPEN;
                        if (inner == SEARCHING) {
                            HALVE_BUNDLE(bundle, far)
                            stack[depth] = far;
                            depth += 1;
                            path *= 2;
                        }
                    }
                }
            }
            if (inner == EMPTY) {
                start = stop;
                stop = end;
                if (!(start < end)) verdict = EMPTY;
            } else {
                real width = reach / real(1 << depth);
                start = start + width * real(path - (1 << depth));
                stop = start + width;
                verdict = inner;
                tries += 1;
                real wider = WIDENING * width;
                if (inner == OPEN && tries <= REFITS && (wider < reach || path > (1 << depth))) {
                    verdict = SEARCHING;
                    stop = min(start + wider, end);
                } else if (inner == OPEN && !leans && LEANS > 0) {
                    // once more in planes that lean as the surface does
                    open_start = start;
                    open_width = width;
                    leans = true;
                    lean = lean_of(work, frame, tile, start, stop);
                    spent += 64;
                    Tile other = leaning(tile, lean);
                    real share = fabs(lean.across) + fabs(lean.down);
                    real other_aside = cells * frame.far * widest_of(other);
                    if (share < 0.25 && other_aside < ASIDE && lean.range < width) {
                        verdict = SEARCHING;
                        tries = 0;
                        tile = other;
                        EACH_LANE {
                            KEEP_NUMBER(weights, remainder_weight(work, tile))
                        }
                        aside = other_aside;
                        rim = RIM * 1.0009765625 * frame.far * corner_of(tile) + rounding;
                        start = (frame.middle + start) * (1.0 - share) - frame.middle - rounding;
                        end = (frame.middle + end) * (1.0 + share) - frame.middle + rounding;
                        stop = min(lean.middle + 2.0 * lean.range + width, end);
                        if (stop <= start) stop = end;
                    }
                }
            }
        }
        if (verdict == SINGLE) spent += 16 * (N + 1);
        int share = (spent + work.tile * work.tile - 1) / (work.tile * work.tile);
        if (verdict == EMPTY) answer_empty(work, i0, j0, share);
        if (verdict == SINGLE) {
            real width = stop - start;
            bool whole = true;
            Lanes roots;
            Lanes slopes;
            EACH_LANE {
                WideRay node = node_ray(work, frame, tile);
                WideVec3 front = wide_point(node.origin, wide(start), node.direction);
                WideVec3 back = wide_point(node.origin, wide(stop), node.direction);
                bool here = all_lanes(BOTH(inside(front, -rim), inside(back, -rim)));
                whole = whole && here;
                SAMPLE(s, node.origin, node.direction, start, width)
                if (negative) SCALE(s, -1.0)
                FIT(s, c)
                WideRoot found;
                FIND_ROOT(found, c, NOT(NOWHERE))
                wide root = start + width * found.x;
                wide slope = width / found.slope;
                if (negative) slope = -slope;
                KEEP_NUMBER(roots, root)
                KEEP_NUMBER(slopes, slope)
            }
            TO_CUBIC(roots)
            TO_CUBIC(slopes)
            list_single(work, cell, roots, slopes, start, stop, whole, share, lean.across, lean.down);
        }
        if (verdict == OPEN) {
            if (leans) {
                // no ray has a root before this depth
                real share = fabs(lean.across) + fabs(lean.down);
                start = max(open_start, (frame.middle + start) / (1.0 + share) - frame.middle);
                stop = start + open_width;
            }
            real slack = 8.0 * UNIT_ROUNDOFF * (fabs(start) + DOMAIN_RADIUS);
            if (LEADS) list_open(work, cell, start - slack, start + AHEAD * (stop - start), spent / 4);
        }
    }
    if (LEADS) {
        add_to(work, 4 * work.level + 2, all_fits);
        add_to(work, 4 * work.level + 3, all_pieces);
    }
}

// The rays of the pixels of a block: o + t d, with d of length 1, begins nearest to the domain's centre. A depth s is
// reached at t = base + (s - frame.middle) length.
STRUCT(Pencil) struct Pencil { WideVec3 o; WideVec3 d; wide shift; wide base; wide length; };

Pencil pencil_of(Work work, Frame frame, int i0, int j0) {
    Pencil rays;
    WideVec3 origin;
    WideVec3 d;
    origin.x = wide(frame.eye.x);
    origin.y = wide(frame.eye.y);
    origin.z = wide(frame.eye.z);
    real size = real(work.size);
    wide x = (2.0 * lane_row(LANE_X, 0) + (real(2 * i0 + 1) - size)) / size;
    wide y = ((size - real(2 * j0 + 1)) - 2.0 * lane_row(LANE_Y, 0)) / size;
    d.x = (frame.forward.x + x * frame.right.x) + y * frame.up.x;
    d.y = (frame.forward.y + x * frame.right.y) + y * frame.up.y;
    d.z = (frame.forward.z + x * frame.right.z) + y * frame.up.z;
    wide inverse = 1.0 / sqrt(wide_inner(d, d));
    d.x = d.x * inverse;
    d.y = d.y * inverse;
    d.z = d.z * inverse;
    if (LISTED == 1) {
        WideRay ray;
        ray.origin = origin;
        ray.direction = d;
        ray = with_listed(work, i0, j0, ray);
        origin = ray.origin;
        d = ray.direction;
    }
    vec3 center = DOMAIN_CENTER;
    rays.d = d;
    rays.shift = (center.x - origin.x) * d.x + (center.y - origin.y) * d.y + (center.z - origin.z) * d.z;
    rays.o.x = wide_advanced(origin.x, rays.shift, d.x);
    rays.o.y = wide_advanced(origin.y, rays.shift, d.y);
    rays.o.z = wide_advanced(origin.z, rays.shift, d.z);
    rays.length = 1.0 / (d.x * frame.normal.x + d.y * frame.normal.y + d.z * frame.normal.z);
    rays.base = (frame.normal.x * (frame.origin.x - rays.o.x) + frame.normal.y * (frame.origin.y - rays.o.y)
                 + frame.normal.z * (frame.origin.z - rays.o.z)) * rays.length;
    return rays;
}

// Newton's method on f itself within [a, b], from t on. `g` is the inverse of f's slope; it becomes that of the secant
// where a step is so long that rounding errors do not matter. `good`: the last step is short, and f changes its sign between two points at
// which it was evaluated.
STRUCT(Refined) struct Refined { wide t; yes good; int evaluations; };

Refined refined(Work work, Pencil rays, wide from, wide a, wide b, wide g, yes looking) {
    real share = max(TOLERANCE, FINEST * UNIT_ROUNDOFF);
    real tolerance = share * (2.0 * DOMAIN_RADIUS);
    real longest = min(STEP, SHORT * sqrt(share)) * (2.0 * DOMAIN_RADIUS);
    real clear = 32.0 * UNIT_ROUNDOFF * (2.0 * DOMAIN_RADIUS);  // a step in which rounding errors do not matter
    wide lo = a;
    wide hi = b;
    wide t = clamp(from, a, b);
    wide f = wide_value(wide_point(rays.o, t, rays.d));
    yes behind = MORE(f * g, wide(0.0));  // the root is before t
    yes seen_before = NOT(behind);
    yes seen_behind = behind;
    hi = CHOOSE(behind, t, hi);
    lo = CHOOSE(behind, lo, t);
    wide next = t - f * g;
    next = CHOOSE(BOTH(NOT(LESS(next, lo)), NOT(MORE(next, hi))), next, 0.5 * (lo + hi));
    wide step = next - t;
    int evaluations = 1;
    for (int k = 0; k < STEPS && any_lane(BOTH(looking, MORE(fabs(step), wide(longest)))); k++) {
        wide f1 = wide_value(wide_point(rays.o, next, rays.d));
        evaluations += 1;
        wide secant = step / (f1 - f);
        g = CHOOSE(BOTH(MORE(fabs(step), wide(clear)), MORE(secant * g, wide(0.0))), secant, g);
        t = next;
        f = f1;
        behind = MORE(f * g, wide(0.0));
        seen_before = EITHER(seen_before, NOT(behind));
        seen_behind = EITHER(seen_behind, behind);
        hi = CHOOSE(behind, t, hi);
        lo = CHOOSE(behind, lo, t);
        next = t - f * g;
        next = CHOOSE(BOTH(NOT(LESS(next, lo)), NOT(MORE(next, hi))), next, 0.5 * (lo + hi));
        step = next - t;
    }
    // one last step with the mean of f over points around t, in which rounding errors cancel; a second one where the
    // first leaves too much by its own estimate: it leaves that share of itself which is left of f
    yes short_step = AT_MOST(fabs(step), wide(longest));
    wide left = fabs(step);
    for (int turn = 0; turn < LAST_STEPS && PAIRS > 0; turn++) {
        if (turn > 0 && !any_lane(BOTH(looking, MORE(left, wide(tolerance))))) break;
        wide sum = wide(0.0);
        for (int k = 1; k <= PAIRS; k++) {
            real away = real(k) * (APART * UNIT_ROUNDOFF * 2.0 * DOMAIN_RADIUS);
            wide before = wide_value(wide_point(rays.o, next - away, rays.d));
            wide after = wide_value(wide_point(rays.o, next + away, rays.d));
            sum += before + after;
            seen_before = EITHER(seen_before, NOT(MORE(before * g, wide(0.0))));
            seen_behind = EITHER(seen_behind, MORE(after * g, wide(0.0)));
        }
        evaluations += 2 * PAIRS;
        wide mean = sum * (1.0 / real(max(2 * PAIRS, 1)));
        wide secant = step / (mean - f);
        g = CHOOSE(BOTH(MORE(fabs(step), wide(clear)), MORE(secant * g, wide(0.0))), secant, g);
        step = -mean * g;
        next = next + step;
        left = fabs(step) * min(fabs(mean), fabs(f)) / max(fabs(f), wide(REAL_TINY));
        left = CHOOSE(MORE(fabs(step), wide(0.25 * clear)), left, wide(0.0));  // a step among rounding errors
        f = mean;
    }
    yes seen = BOTH(seen_before, seen_behind);
    if (any_lane(BOTH(looking, NOT(seen)))) {
        wide other = wide_value(wide_point(rays.o, CHOOSE(seen_before, b, a), rays.d));
        evaluations += 1;
        behind = MORE(other * g, wide(0.0));
        seen = EITHER(seen, CHOOSE(seen_before, behind, NOT(behind)));
    }
    Refined result;
    result.t = clamp(next, lo, hi);
    result.good = BOTH(BOTH(seen, short_step), AT_MOST(left, wide(PAIRS > 0 ? tolerance : longest)));
    result.evaluations = evaluations;
    return result;
}

// A cubic polynomial a + b u + c u² + d u³, and one whose coefficients are cubic polynomials of u.
STRUCT(Cubic) struct Cubic { real a; real b; real c; real d; };
STRUCT(Bicubic) struct Bicubic { Cubic r0; Cubic r1; Cubic r2; Cubic r3; };

Cubic kept_cubic(Work work, int place) {
    Cubic cubic;
    cubic.a = entry_at(work, place);
    cubic.b = entry_at(work, place + 1);
    cubic.c = entry_at(work, place + 2);
    cubic.d = entry_at(work, place + 3);
    return cubic;
}

Bicubic kept_bicubic(Work work, int place) {
    Bicubic bicubic;
    bicubic.r0 = kept_cubic(work, place);
    bicubic.r1 = kept_cubic(work, place + 4);
    bicubic.r2 = kept_cubic(work, place + 8);
    bicubic.r3 = kept_cubic(work, place + 12);
    return bicubic;
}

wide cubic_value(Cubic p, wide u) {
    return ((p.d * u + p.c) * u + p.b) * u + p.a;
}

wide bicubic_value(Bicubic p, wide u, wide v) {
    return ((cubic_value(p.r3, u) * v + cubic_value(p.r2, u)) * v + cubic_value(p.r1, u)) * v + cubic_value(p.r0, u);
}

// Stage 2. Pixels of single tiles: bicubic interpolation of the nodes' roots, and then f itself.
void finish_tiles(Work work, Frame frame) {
    int across = tiles_across(work.size, work.tile);
    int total = counted(work, 4 * work.level + 1);
    int list = QUEUE_RECORD * tiles_before(work.size, work.tile) + across * across;
    real half_side = 0.5 * real(work.tile - 1) + WIDER;
    real slack = 16.0 * UNIT_ROUNDOFF * DOMAIN_RADIUS;
    int blocks = work.tile / 4;
    for (int turn = 0;; turn++) {
        int taken = next_tile(work, TAKEN + 8 + work.level, turn);
        if (taken >= total) break;
        int cell = queued(work, list + taken);
        int record = singles_at(work.size, work.tile) + SINGLE_RECORD * taken;
        Bicubic roots = kept_bicubic(work, record);
        Bicubic slopes = kept_bicubic(work, record + 16);
        real start = entry_at(work, record + 32);
        real stop = entry_at(work, record + 33);
        bool whole = entry_at(work, record + 34) > 0.0;
        int spent = int(entry_at(work, record + 35));
        real lean_x = entry_at(work, record + 36);
        real lean_y = entry_at(work, record + 37);
        real shrunk = 1.0 - fabs(lean_x) - fabs(lean_y);
        for (int block = 0; block < blocks * blocks; block++) {
            int bi = 4 * (block % blocks);
            int bj = 4 * (block / blocks);
            int i0 = (cell % across) * work.tile + bi;
            int j0 = (cell / across) * work.tile + bj;
            if (i0 >= work.size || j0 >= work.size) continue;
            Pencil rays = pencil_of(work, frame, i0, j0);
            wide u = (lane_row(LANE_X, 0) + (real(bi) - 0.5 * real(work.tile - 1))) / half_side;
            wide v = (lane_row(LANE_Y, 0) + (real(bj) - 0.5 * real(work.tile - 1))) / half_side;
            // in the nodes' planes, which lean, the place and the depth are `grown` times those in planes of one depth
            wide deeper = lean_x * u + lean_y * v;
            wide grown = 1.0 / (1.0 - deeper);
            u = u * grown * shrunk;
            v = v * grown * shrunk;
            wide root = bicubic_value(roots, u, v);
            wide g = bicubic_value(slopes, u, v);
            wide begin = rays.base + frame.middle * deeper * grown * rays.length;
            wide length = grown * rays.length;
            wide a = begin + start * length - slack;
            wide b = begin + stop * length + slack;
            Refined found = refined(work, rays, begin + root * length, a, b, g * length, NOT(NOWHERE));
            yes hit = NOT(NOWHERE);
            yes left = NOT(found.good);
            if (!whole) {
                WideSpan span = wide_span(rays.o, rays.d, 0.0);
                span.lo = max(span.lo, -rays.shift);
                hit = NOT(EITHER(MORE(span.lo, span.hi), MORE(found.t, span.hi)));
                left = BOTH(hit, EITHER(left, LESS(found.t, span.lo)));
            }
            answer_block(work, i0, j0, rays.shift, found.t, hit, LEVELS + work.level, spent + found.evaluations);
            if (any_lane(left)) leave_pixels(work, i0, j0, left, wide((frame.middle + start) / (2.0 - shrunk) - frame.middle));
        }
    }
}

// Stage 3. Pixels of open tiles, in blocks of 4 by 4: each has its own fit, and they are halved together.
void cast_packets(Work work, Frame frame) {
    Poly stack[HALVINGS];
    int across = tiles_across(work.size, work.tile);
    int list = tiles_before(work.size, work.tile);
    int blocks = work.tile / 4;
    int total = blocks * blocks * counted(work, 4 * (work.level - 1));
    real slack = 16.0 * UNIT_ROUNDOFF * DOMAIN_RADIUS;
    int all_fits = 0;
    int all_pieces = 0;
    for (int turn = 0;; turn++) {
        int taken = next_tile(work, TAKEN + 16, turn);
        if (taken >= total) break;
        int slot = taken / (blocks * blocks);
        int block = taken % (blocks * blocks);
        int cell = queued(work, QUEUE_RECORD * list + slot);
        int record = (OPEN_RECORD + SINGLE_RECORD) * list + OPEN_RECORD * slot;
        real start = entry_at(work, record);
        real stop = entry_at(work, record + 1);
        int i0 = (cell % across) * work.tile + 4 * (block % blocks);
        int j0 = (cell / across) * work.tile + 4 * (block / blocks);
        if (i0 >= work.size || j0 >= work.size) continue;
        Pencil rays = pencil_of(work, frame, i0, j0);
        // the same rays with their depth as parameter, less frame.middle
        WideVec3 o = wide_point(rays.o, rays.base, rays.d);
        WideVec3 d;
        d.x = rays.d.x * rays.length;
        d.y = rays.d.y * rays.length;
        d.z = rays.d.z * rays.length;
        WideSpan span = wide_span(rays.o, rays.d, 0.0);
        span.lo = max(span.lo, -rays.shift);
        wide own_lo = (span.lo - rays.base) / rays.length;
        wide own_hi = (span.hi - rays.base) / rays.length + slack;
        yes waiting = AT_MOST(span.lo, span.hi);
        waiting = BOTH(waiting, AT_MOST(wide(start), own_hi));
        yes opened = NOWHERE;
        yes found = NOWHERE;
        wide open_from = wide(start);
        wide found_start = wide(0.0);
        wide found_width = wide(0.0);
        wide sign = wide(1.0);
        start = max(start, least(CHOOSE(waiting, own_lo, wide(REAL_INFINITY))) - slack);
        real end = most(CHOOSE(waiting, own_hi, wide(-REAL_INFINITY)));
        stop = min(stop, end);
        if (stop <= start) stop = end;
        Poly c;
        Poly s;
        Poly q;
        CONSTANT(q, wide(0.0))
        int fits = 0;
        real open_width = 0.0;
        while (any_lane(waiting) && start < end) {
            real reach = stop - start;
            WideVec3 front = wide_point(o, start, d);
            WideVec3 back = wide_point(o, stop, d);
            int inner = SEARCHING;
            if (!all_lanes(BOTH(inside(front, MARGIN), inside(back, MARGIN)))) {
                open_from = CHOOSE(waiting, wide(start), open_from);
                opened = EITHER(opened, waiting);
                waiting = NOWHERE;
                inner = OPEN;
            }
            if (inner == SEARCHING) {
                SAMPLE(s, o, d, start, reach)
                fits += 1;
                wide own_sign = CHOOSE(LESS(FIRST(s), wide(0.0)), wide(-1.0), wide(1.0));
                sign = CHOOSE(waiting, own_sign, sign);
                SCALE(s, own_sign)
                FIT(s, c)
                wide unit = TRUST * UNIT_ROUNDOFF * LARGEST(c);
                wide noise = 2.0 * TRUST * UNIT_ROUNDOFF * real(N / 2 + 6) * WEIGHTED(s);
                real off = rounding_of_samples(sqrt(most(squared_distance(front, back))));
                int depth = 0;
                int path = 1;
                while (inner == SEARCHING) {
                    wide error = GROWTH[min(depth, DEPTHS)] * off + noise + real(N * (depth + 1)) * unit;
                    all_pieces += 1;
                    real width = reach / real(1 << depth);
                    real from = start + width * real(path - (1 << depth));
                    waiting = BOTH(waiting, AT_MOST(wide(from), own_hi));
                    yes unsure = BOTH(waiting, NOT(MORE(LEAST(c), error)));
                    yes one = BOTH(unsure, BOTH(LESS(LAST(c), -error), MORE(FIRST(c), error)));
                    if (any_lane(one)) {
                        wide after;
                        LARGEST_AFTER(c, error, after)
                        one = BOTH(one, EITHER(LESS(after, -error), LESS(STEEPEST(c), -2.0 * error)));
                        found_start = CHOOSE(one, wide(from), found_start);
                        found_width = CHOOSE(one, wide(width), found_width);
                        KEEP(q, one, c)
                        found = EITHER(found, one);
                        waiting = BOTH(waiting, NOT(one));
                        unsure = BOTH(unsure, NOT(one));
                    }
                    if (depth == HALVINGS) {
                        open_width = width;
                        open_from = CHOOSE(unsure, wide(from), open_from);
                        opened = EITHER(opened, unsure);
                        waiting = BOTH(waiting, NOT(unsure));
                        unsure = NOWHERE;
                    }
                    if (!any_lane(waiting)) {
                        inner = OPEN;
                    } else if (any_lane(unsure)) {
                        HALVE(c, s)
                        stack[depth] = s;
                        depth += 1;
                        path *= 2;
                    } else {
                        int up = bit_count(path & ~(path + 1));
                        if (up > depth) {
                            inner = EMPTY;
                        } else {
                            depth -= up;
                            path = (path >> up) + 1;
                            c = stack[depth - 1];
                        }
                    }
                }
            }
            start = stop;
            stop = end;
            // what is open is fitted anew, on a shorter piece
            if (any_lane(opened) && open_width > 0.0 && fits < PACKET_FITS) {
                waiting = EITHER(waiting, opened);
                start = least(CHOOSE(opened, open_from, wide(end)));
                stop = min(start + WIDENING * open_width, end);
                opened = NOWHERE;
            }
        }
        all_fits += fits;
        int evaluations = fits * (N + 1);
        yes hit = NOWHERE;
        yes left = opened;
        wide t = wide(0.0);
        if (any_lane(found)) {
            WideRoot inside;
            FIND_ROOT(inside, q, found)
            wide a = rays.base + found_start * rays.length - slack;
            wide b = rays.base + (found_start + found_width) * rays.length + slack;
            wide at = rays.base + (found_start + found_width * inside.x) * rays.length;
            Refined result = refined(work, rays, at, a, b, sign * (found_width / inside.slope) * rays.length, found);
            evaluations += result.evaluations;
            t = result.t;
            hit = BOTH(found, NOT(MORE(t, span.hi)));
            yes again = BOTH(hit, EITHER(NOT(result.good), LESS(t, span.lo)));
            open_from = CHOOSE(again, found_start, open_from);
            left = EITHER(left, again);
        }
        answer_block(work, i0, j0, rays.shift, t, hit, 2 * LEVELS, evaluations);
        open_from = open_from - slack;
        if (any_lane(left)) leave_pixels(work, i0, j0, left, open_from);
    }
    add_to(work, 4 * work.level + 2, all_fits);
    add_to(work, 4 * work.level + 3, all_pieces);
}
