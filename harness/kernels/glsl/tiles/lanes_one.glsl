// Operations on lanes where a work item has one lane, `work.lane`, of the sixteen that share a tile. Lane k is at
// (k & 3, k >> 2). Votes and extrema are those of the lane itself: what leaves this file unsaid, a stage's exchange adds.
#define wide real
#define yes bool
#define FUSED(a, b, c) fma(wide(a), b, c)
#ifdef __OPENCL_VERSION__
#define PRODUCT_ERROR(a, b, product) fma(a, b, -(product))
#else
#define PRODUCT_ERROR(a, b, product) two_prod(a, b).lo
#endif
#define LESS(a, b) ((a) < (b))
#define MORE(a, b) ((a) > (b))
#define AT_MOST(a, b) ((a) <= (b))
#define BOTH(a, b) ((a) && (b))
#define EITHER(a, b) ((a) || (b))
#define NOT(a) (!(a))
#define NOWHERE false
#define CHOOSE(mask, a, b) ((mask) ? (a) : (b))
#ifndef OWN_LANE
#define OWN_LANE work.lane
#endif
#define lane_row(name, k) name[16 * (k) + OWN_LANE]
#define wide_advanced(o, t, d) advanced(o, t, d)
#define fourth_row(work, place) fourth_at(work, (place) + OWN_LANE)
