// A tile's polynomials where each lane has one of them. Halving works on all of them.
#define Net Poly
#define Bundle Poly
#define Lanes wide
#define EACH_ROW
#define EACH_COLUMN
#define KEEP_LANE(net, c) { net = c; }
#define RAISE_SPREAD(net, c, spread) { spread = most(SPREAD(c)); }
#define BEGIN_ROW(net)
#define END_ROW(net)
#define KEEP_NUMBER(lanes, v) { lanes = v; }
#define NUMBER(lanes) lanes
#define TO_CUBIC(lanes) TRANSFORM_ANY(lanes, to_powers)
#define BUNDLED(net, b) { TRANSFORM(net, to_control) b = net; }
#define HALVE_BUNDLE(near, far) HALVE(near, far)
#define LARGEST_IN(b) most(LARGEST(b))
#define ALL_ABOVE(b, e) all_lanes(MORE(LEAST(b), wide(e)))
#define CROSSES(b, e) all_lanes(BOTH(LESS(LAST(b), wide(-e)), MORE(FIRST(b), wide(e))))
#define FALLS(b, e) all_lanes(LESS(STEEPEST(b), wide(-2.0 * e)))
// The far halves that are still to be searched are kept.
#define STACK(stack) Bundle stack[HALVINGS];
#define HOLD(stack, bundle)
#define GO_TO_PIECE(stack, bundle, far, path, depth)
#define HALVE_PIECE(stack, bundle, far, depth) HALVE_BUNDLE(bundle, far) stack[depth] = far;
#define TAKE_PIECE(stack, bundle, depth) bundle = stack[depth - 1];
// Bounds of the fourth derivatives, one a lane.
#define FIND_WEIGHTS(weights, tile) weights = remainder_weight(work, tile.across, tile.down);
#define NO_BOUNDS(bounds) bounds = wide(0.0);
#define RAISE_BOUNDS(bounds, grown, place) bounds = max(bounds, grown * fourth_row(work, place));
#define WEIGHED(weights, bounds) total(weights * bounds)

// Returns |v| to each lane's power, 0 to 4.
wide power_of(wide power, real v) {
    wide result = wide(1.0);
    for (int k = 0; k < 4; k++) result = CHOOSE(MORE(power, wide(real(k))), fabs(v) * result, result);
    return result;
}

// Returns each lane's factor of a fourth derivative in the bound of a tile's remainder at depth 1.
wide remainder_weight(Work work, vec3 along_u, vec3 along_v) {
    wide x = lane_row(POWERS_X, 0);
    wide y = lane_row(POWERS_Y, 0);
    wide z = lane_row(POWERS_Z, 0);
    wide across = power_of(x, along_u.x) * power_of(y, along_u.y) * power_of(z, along_u.z);
    wide down = power_of(x, along_v.x) * power_of(y, along_v.y) * power_of(z, along_v.z);
    return REMAINDER_X * across + REMAINDER_Y * down;
}
