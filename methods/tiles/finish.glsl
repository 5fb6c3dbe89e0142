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
    return FUSED(FUSED(FUSED(p.d, u, wide(p.c)), u, wide(p.b)), u, wide(p.a));
}

wide bicubic_value(Bicubic p, wide u, wide v) {
    return FUSED(FUSED(FUSED(cubic_value(p.r3, u), v, cubic_value(p.r2, u)), v, cubic_value(p.r1, u)), v,
                 cubic_value(p.r0, u));
}

// Stage 2. Pixels of single tiles: bicubic interpolation of the nodes' roots, and then f itself.
void finish_tiles(Work work, Frame frame) {
    int across = tiles_across(work.size, work.tile);
    int total = counted(work, 4 * work.level + 1);
    int list = QUEUE_RECORD * tiles_before(work.size, work.tile) + across * across;
    real middle = 0.5 * real(work.tile - 1);  // of a tile, in pixels
    real scale = 1.0 / (middle + WIDER);
    real slack = 16.0 * UNIT_ROUNDOFF * DOMAIN_RADIUS;
    int wide_blocks = work.tile / BLOCK_WIDTH;
    int blocks = work.tile * work.tile / 16;
    int parts = min(FINISH_PARTS, blocks);  // of a tile, each taken by itself
    total = parts * total;
    for (int turn = 0;; turn++) {
        int taken = next_tile(work, TAKEN + 8 + work.level, total, turn);
        if (taken >= total) break;
        int slot = taken / parts;
        int first = (taken % parts) * (blocks / parts);
        int cell = queued(work, list + slot);
        int record = singles_at(work.size, work.tile) + SINGLE_RECORD * slot;
        int behind = int(entry_at(work, record + 37));
        int spent = int(entry_at(work, record + 38));
        for (int part = 0; part < (behind == IN_SECOND ? 2 : 1); part++) {
            int piece = record + PIECE_RECORD * part;
            Bicubic roots = kept_bicubic(work, piece);
            Bicubic slopes = kept_bicubic(work, piece + 16);
            real start = entry_at(work, piece + 32);
            real stop = entry_at(work, piece + 33);
            bool whole = entry_at(work, piece + 34) > 0.0;
            real lean_x = entry_at(work, piece + 35);
            real lean_y = entry_at(work, piece + 36);
            real shrunk = 1.0 - fabs(lean_x) - fabs(lean_y);
            for (int block = first; block < first + blocks / parts; block++) {
                int bi = BLOCK_WIDTH * (block % wide_blocks);
                int bj = (16 / BLOCK_WIDTH) * (block / wide_blocks);
                int i0 = (cell % across) * work.tile + bi;
                int j0 = (cell / across) * work.tile + bj;
                if (i0 >= work.size || j0 >= work.size) continue;
                yes looking = part == 0 ? NOT(NOWHERE) : passed_pixels(work, i0, j0);
                if (!any_lane(looking)) continue;
                Pencil rays = pencil_of(work, frame, i0, j0);
                wide u = (lane_row(LANE_X, 0) + (real(bi) - middle)) * scale;
                wide v = (lane_row(LANE_Y, 0) + (real(bj) - middle)) * scale;
                wide begin = rays.base;
                wide length = rays.length;
                if (shrunk < 1.0) {
                    // in planes that lean, the place and the depth are `grown` times those in planes of one depth
                    wide deeper = lean_x * u + lean_y * v;
                    wide grown = 1.0 / (1.0 - deeper);
                    u = u * grown * shrunk;
                    v = v * grown * shrunk;
                    begin = begin + frame.middle * deeper * grown * length;
                    length = grown * length;
                }
                wide root = bicubic_value(roots, u, v);
                wide g = bicubic_value(slopes, u, v);
                wide a = begin + start * length - slack;
                wide b = begin + stop * length + slack;
                Refined found = refined(rays, begin + root * length, a, b, g * length, looking);
                yes hit = looking;
                yes left = BOTH(looking, NOT(found.good));
                yes passed = NOWHERE;
                yes within = BOTH(inside(wide_point(rays.o, found.t, rays.d), -slack), AT_MOST(-rays.shift, found.t));
                if (!whole && !all_lanes(within)) {
                    WideSpan span = wide_span(rays.o, rays.d, 0.0);
                    span.lo = max(span.lo, -rays.shift);
                    hit = BOTH(hit, NOT(EITHER(MORE(span.lo, span.hi), MORE(found.t, span.hi))));
                    left = BOTH(hit, left);
                    yes early = BOTH(BOTH(hit, NOT(left)), LESS(found.t, span.lo));
                    hit = BOTH(hit, NOT(early));
                    if (part > 0 || behind == UNKNOWN) left = EITHER(left, early);
                    else if (behind == IN_SECOND) passed = early;
                }
                int stage = LEVELS + work.level;
                if (part == 0) answer_block(work, i0, j0, rays.shift, found.t, hit, stage, spent + found.evaluations);
                else answer_again(work, i0, j0, looking, rays.shift, found.t, hit, stage, found.evaluations);
                if (any_lane(passed)) pass_pixels(work, i0, j0, passed);
                // no ray has a root in the domain before this depth
                real before = (frame.middle + start) / (2.0 - shrunk) - frame.middle;
                if (any_lane(left)) leave_pixels(work, i0, j0, left, wide(before));
            }
        }
    }
}
