// A tile's polynomials where each lane has one of them. Halving works on all of them.
#define Net Poly
#define Bundle Poly
#define Lanes wide
#define KEEP_LANE(net, c) { net = c; }
#define KEEP_NUMBER(lanes, v) { lanes = v; }
#define RAISE_NUMBER(lanes, v) { lanes = max(lanes, v); }
#define NUMBER(lanes) lanes
#define CONTROL(net) TRANSFORM(net, to_control)
#define TO_CUBIC(lanes) TRANSFORM_ANY(lanes, to_powers)
#define FIND_SPREAD(net, spread) { spread = most(SPREAD(net)); }
#define BUNDLED(net, b) { b = net; }
#define HALVE_BUNDLE(near, far) HALVE(near, far)
#define LARGEST_IN(b) most(LARGEST(b))
#define ALL_ABOVE(b, e) all_lanes(MORE(LEAST(b), wide(e)))
#define CROSSES(b, e) all_lanes(BOTH(LESS(LAST(b), wide(-e)), MORE(FIRST(b), wide(e))))
#define FALLS(b, e) all_lanes(LESS(STEEPEST(b), wide(-2.0 * e)))
