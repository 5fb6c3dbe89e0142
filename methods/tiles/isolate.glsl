// The stage that isolates: searches tiles of one level for pieces of depth that hold the first roots of all their rays.
#define RIM 0.0390625          // from the outermost nodes to the square's sides, in half sides: 5/128
#define GAP 0.3984375          // half the distance between the inner nodes: 51/128
#define BALLAST 7.0            // worst rounding error of TRANSFORM in unit roundoffs of the largest coefficient,
#define MIXING 220.0           // and of the largest difference of two lanes
#define ASIDE 0.75             // most cells that a tile's rays may be from its middle ray, in one coordinate
#define COARSE 8                // highest degree at which bounds are looked up in coarser tables first
#define NEGLIGIBLE 0.25        // part that the remainder may have of what a tile's rays differ by, before it is looked up

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

int cell_of(real place, int side) {
    return clamp(int(place), 0, side - 1);
}

// Bounds the remainder of the tile's interpolation between two depths, from the bounds of fourth derivatives, one a
// lane, that are looked up along the tile's middle ray in the table whose cells are 2^coarser times as long as those of
// the finest. A cell's bounds hold one cell beyond it. So if the tile's rays are `aside` cells from the middle one, steps
// of 2 (1 - aside) cells leave nothing out. Up to degree 4 the derivatives are the same everywhere.
real remainder_by(Work work, Frame frame, Tile tile, Lanes weights, real widest, int coarser, real start, real stop) {
    if (N < 4) return 0.0;
    int side = GRID >> coarser;
    int before = 0;  // cells of finer tables
    for (int k = 0; k < coarser; k++) before += (GRID >> k) * (GRID >> k) * (GRID >> k);
    real cells = real(side) / (2.0 * TABLE_HALF);
    real aside = cells * widest;
    vec3 a = difference(ray_point(tile.middle, start), DOMAIN_CENTER);
    vec3 b = difference(ray_point(tile.middle, stop), DOMAIN_CENTER);
    vec3 way = difference(b, a);
    real most_way = max(fabs(way.x), max(fabs(way.y), fabs(way.z)));
    int steps = N > 4 ? 1 + int(cells * most_way / (2.0 * (0.9990234375 - aside))) : 0;
    real share = N > 4 ? 1.0 / real(steps) : 2.0;  // 2: the bound is taken at the largest depth
    Lanes bounds;
    NO_BOUNDS(bounds)
    for (int k = 0; k <= steps; k++) {
        vec3 p = moved(a, share * real(k), way);
        int z = cell_of(cells * p.z + 0.5 * real(side), side);
        int y = cell_of(cells * p.y + 0.5 * real(side), side);
        int x = cell_of(cells * p.x + 0.5 * real(side), side);
        int cell = N > 4 ? before + (z * side + y) * side + x : 0;
        real depth = frame.middle + min(start + share * (real(k) + 0.5) * (stop - start), stop);
        real grown = (depth * depth) * (depth * depth);
        RAISE_BOUNDS(bounds, grown, 16 * cell)
    }
    return WEIGHED(weights, bounds);
}

// Bounds the remainder as remainder_by, by a finer table only where a coarser one leaves so much that it may decide:
// more than a share of `spread`, by which the tile's rays differ.
real remainder_between(Work work, Frame frame, Tile tile, Lanes weights, real widest, real spread, real start,
                       real stop) {
    real bound = REAL_INFINITY;
    real cells = real(GRID) / (2.0 * TABLE_HALF);
    int finest = 0;
    while (N > 4 && finest < TABLES - 1 && cells * widest > ASIDE * real(1 << finest)) finest += 1;
    for (int coarser = max(finest, N <= COARSE ? TABLES - 1 : 0); coarser >= finest; coarser--) {
        if (bound * GROWTH[0] > NEGLIGIBLE * spread) {
            bound = min(bound, remainder_by(work, frame, tile, weights, widest, coarser, start, stop));
        }
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

// Stage 1. Tiles of one level: each is empty, single (every ray has its first root in one piece, and no other root
// there), or open, and then its four quarters are searched on the next level, or its pixels by stage 3.
void isolate_tiles(Work work, Frame frame) {
    STACK(stack)
    int across = tiles_across(work.size, work.tile);
    int total = tiles_to_take(work);
    real half_side = 0.5 * real(work.tile - 1) + WIDER;
    real rounding = 64.0 * UNIT_ROUNDOFF * DOMAIN_RADIUS;
    real widest_allowed = N > 4 ? ASIDE * real(1 << (TABLES - 1)) * (2.0 * TABLE_HALF) / real(GRID) : REAL_INFINITY;
    real least_width = SHORTEST * real(work.tile) * frame.pixel * frame.far;
    Rows to_control;
    Rows to_powers;
    MAKE_ROWS(to_control, TO_CONTROL)
    MAKE_ROWS(to_powers, TO_POWERS)
    int all_fits = 0;
    int all_pieces = 0;
    for (int turn = 0;; turn++) {
        int number = next_tile(work, TAKEN + work.level, total, turn);
        if (number >= total) break;
        Taken taken = taken_tile(work, number);
        if (taken.x >= across || taken.y >= across) continue;
        bool first = taken.record < 0;
        real start = first ? -REAL_INFINITY : entry_at(work, taken.record);
        real stop = first ? REAL_INFINITY : entry_at(work, taken.record + 1);
        int spent = first ? 0 : int(entry_at(work, taken.record + 2));
        int cell = taken.y * across + taken.x;
        int i0 = taken.x * work.tile;
        int j0 = taken.y * work.tile;

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
        real widest = frame.far * widest_of(tile);
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
        }
        FIND_WEIGHTS(weights, tile)
        start = max(start, max(near, -frame.middle));
        stop = min(stop, end);
        if (stop <= start) stop = end;
        int verdict = start < end ? SEARCHING : EMPTY;
        if (widest > widest_allowed && verdict == SEARCHING) {
            verdict = OPEN;
            stop = end;
        }
        int depth = 0;
        int path = 1;
        int tries = 0;
        int pieces = 0;  // that hold a root of each ray, and are entered in `record`
        int record = -1;
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
                real spread = 0.0;
                EACH_ROW {
                    BEGIN_ROW(net)
                    EACH_COLUMN {
                        WideRay node = node_ray(work, frame, tile);
                        SAMPLE(s, node.origin, node.direction, start, reach)
                        if (FIRST_TURN) negative = first_lane_number(FIRST(s)) < 0.0;
                        if (negative) SCALE(s, -1.0)
                        FIT(s, c)
                        weighted = max(weighted, most(WEIGHTED(s)));
                        KEEP_LANE(net, c)
                        RAISE_SPREAD(net, c, spread)
                    }
                    END_ROW(net)
                }
                all_fits += 1;
                spent += 16 * (N + 1);
                BUNDLED(net, bundle)
                Errors errors;
                errors.unit = TRUST * UNIT_ROUNDOFF * LARGEST_IN(bundle);
                errors.off = LEBESGUE * LEBESGUE * rounding_of_samples(sqrt(squared) + rim)
                             + remainder_between(work, frame, tile, weights, widest, spread, start, stop);
                errors.noise = TRUST * UNIT_ROUNDOFF * (2.0 * LEBESGUE * LEBESGUE * real(N / 2 + 6) * weighted
                                                        + MIXING * 2.0 * spread) + BALLAST * errors.unit;
                HOLD(stack, bundle)
                while (inner == SEARCHING) {
                    GO_TO_PIECE(stack, bundle, far, path, depth)
                    real error = error_at(errors, depth);
                    all_pieces += 1;
                    if (ALL_ABOVE(bundle, error)) {
                        int up = bit_count(path & ~(path + 1));  // far halves that end here, with the piece itself
                        if (up > depth) {
                            inner = EMPTY;
                        } else {
                            depth -= up;
                            path = (path >> up) + 1;
                            TAKE_PIECE(stack, bundle, depth)
                        }
                    } else {
                        if (CROSSES(bundle, error)) {
                            bool falls = FALLS(bundle, error);
                            if (!falls) falls = single_bits(SURE_ABOVE(bundle, error), SURE_BELOW(bundle, error)) >= N;
                            if (falls) inner = SINGLE;
                        }
                        real shortest = leans ? 0.25 * least_width : least_width;
                        bool deepest = depth == HALVINGS || reach < shortest * real(1 << depth);
                        if (inner == SEARCHING && deepest) inner = OPEN;
                        if (inner == SEARCHING) {
                            HALVE_PIECE(stack, bundle, far, depth)
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
                    real other_widest = frame.far * widest_of(other);
                    if (share < 0.25 && other_widest < widest_allowed && lean.range < width) {
                        verdict = SEARCHING;
                        tries = 0;
                        tile = other;
                        FIND_WEIGHTS(weights, tile)
                        widest = other_widest;
                        rim = RIM * 1.0009765625 * frame.far * corner_of(tile) + rounding;
                        start = (frame.middle + start) * (1.0 - share) - frame.middle - rounding;
                        end = (frame.middle + end) * (1.0 + share) - frame.middle + rounding;
                        stop = min(lean.middle + 2.0 * lean.range + width, end);
                        if (stop <= start) stop = end;
                    }
                }
            }
            if (verdict == SINGLE) {
                real width = stop - start;
                bool whole = true;
                bool early = false;  // whether a node's root lies before its ray is in the domain
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
                    WideSpan span = wide_span(node.origin, node.direction, 0.0);
                    bool outside = any_lane(LESS(root, max(span.lo, wide(-frame.middle))));
                    early = early || outside;
                }
                spent += 16 * (N + 1);
                TO_CUBIC(roots)
                TO_CUBIC(slopes)
                if (pieces == 0) record = new_single(work, cell);
                enter_single(work, record + PIECE_RECORD * pieces, roots, slopes, start, stop, whole, lean.across,
                             lean.down);
                pieces += 1;
                if (early && pieces == 1) {
                    // rays whose root lies before the domain have their first one in it behind this piece
                    start = stop;
                    stop = end;
                    tries = 0;
                    verdict = start < end ? SEARCHING : EMPTY;
                }
            }
        }
        int share = (spent + work.tile * work.tile - 1) / (work.tile * work.tile);
        if (pieces > 0) {
            int behind = pieces > 1 ? IN_SECOND : verdict == EMPTY ? NOTHING : UNKNOWN;
            if (LEADS) enter_single_end(work, record, behind, share);
        } else if (verdict == EMPTY) {
            answer_empty(work, i0, j0, share);
        }
        if (verdict == OPEN && pieces == 0) {
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
