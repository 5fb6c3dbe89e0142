// Operations on lanes where one work item has all sixteen as one vector. Lane k is at (k & 3, k >> 2).
#define wide(v) ((wide)(v))
#define FUSED(a, b, c) fma(wide(a), b, c)
#define PRODUCT_ERROR(a, b, product) fma(a, b, -(product))
#define LESS(a, b) ((a) < (b))
#define MORE(a, b) ((a) > (b))
#define AT_MOST(a, b) ((a) <= (b))
#define BOTH(a, b) ((a) & (b))
#define EITHER(a, b) ((a) | (b))
#define NOT(a) (~(a))
#define NOWHERE ((yes)(0))
#define CHOOSE(mask, a, b) select(b, a, mask)
// OpenCL's any and all make vectors of masks and shuffle them; a compiler that reduces masks asks all lanes at once.
#if defined(__has_builtin)
#if __has_builtin(__builtin_reduce_or) && __has_builtin(__builtin_reduce_and)
#define any_lane(mask) (__builtin_reduce_or(mask) != 0)
#define all_lanes(mask) (__builtin_reduce_and(mask) != 0)
#endif
#endif
#ifndef any_lane
#define any_lane(mask) (any(mask) != 0)
#define all_lanes(mask) (all(mask) != 0)
#endif
#define first_lane(v) ((wide)((v).s0))
#define first_lane_number(v) ((v).s0)
#define lane_row(name, k) vload16(k, name)
#define fourth_row(work, place) vload16(0, (work).fourths + (place))
#define EACH_LANE
#define FIRST_TURN true

// Reads lanes whose index differs in some bits.
#define OTHER_1(v) ((v).s1032547698badcfe)
#define OTHER_2(v) ((v).s23016745ab89efcd)
#define OTHER_3(v) ((v).s32107654ba98fedc)
#define OTHER_4(v) ((v).s45670123cdef89ab)
#define OTHER_8(v) ((v).s89abcdef01234567)
#define OTHER_12(v) ((v).scdef89ab45670123)

real most(wide v) {
    real lanes[8];
    vstore8(max(v.lo, v.hi), 0, lanes);
    return max(max(max(lanes[0], lanes[1]), max(lanes[2], lanes[3])), max(max(lanes[4], lanes[5]), max(lanes[6], lanes[7])));
}

real total(wide v) {
    real lanes[8];
    vstore8(v.lo + v.hi, 0, lanes);
    return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

real least(wide v) {
    return -most(-v);
}

// Returns o + t d with about one rounding, as advanced does.
wide wide_advanced(wide o, wide t, wide d) {
    wide product = t * d;
    wide low = fma(t, d, -product);
    wide sum = o + product;
    wide c = sum - o;
    wide lost = (o - (sum - c)) + (product - c);
    return sum + (lost + low);
}
