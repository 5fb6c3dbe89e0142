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
        int taken = next_tile(work, TAKEN + 16, total, turn);
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
            Refined result = refined(rays, at, a, b, sign * (found_width / inside.slope) * rays.length, found);
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
