// Finds the first roots of f along the rays of a camera's pixels, by tiles: squares of pixels whose rays are isolated
// together. Along node rays, 4 by 4 in a tile, f is fitted in Bernstein form; the coefficients are interpolated by
// bicubic polynomials in Bernstein form, whose 16 control values are in the tile's lanes. A sign that all lanes have for
// certain is that of every ray of the tile. Here stands what several stages share; isolate.glsl, finish.glsl, packets.glsl
// and rest.glsl are the stages, refine.glsl and correct.glsl how they refine roots.
#define N SURFACE_DEGREE
#define SHELLS 16  // sizes of the tables VALUE_ERRORS and GROWTH
#define DEPTHS 6
#define WIDER 0.03125          // pixels by which the nodes' square is larger on each side than the pixels' middles
#define THIRD 0.3333333432674407958984375

// What is known behind a single tile's first piece, for rays whose root lies before the domain.
#define UNKNOWN 0
#define IN_SECOND 1  // their next root is in the second piece
#define NOTHING 2

#define SEARCHING 0
#define EMPTY 1
#define SINGLE 2
#define OPEN 3

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

// The rays of the pixels of a block: o + t d, with d of length 1, begins nearest to the domain's centre. A depth s is
// reached at t = base + (s - frame.middle) length.
STRUCT(Pencil) struct Pencil { WideVec3 eye; WideVec3 o; WideVec3 d; wide shift; wide base; wide length; };

Pencil pencil_of(Work work, Frame frame, int i0, int j0) {
    Pencil rays;
    WideVec3 origin;
    WideVec3 d;
    origin.x = wide(frame.eye.x);
    origin.y = wide(frame.eye.y);
    origin.z = wide(frame.eye.z);
    real size = real(work.size);
    real share = 1.0 / size;
    wide x = (2.0 * lane_row(LANE_X, 0) + (real(2 * i0 + 1) - size)) * share;
    wide y = ((size - real(2 * j0 + 1)) - 2.0 * lane_row(LANE_Y, 0)) * share;
    d.x = (frame.forward.x + x * frame.right.x) + y * frame.up.x;
    d.y = (frame.forward.y + x * frame.right.y) + y * frame.up.y;
    d.z = (frame.forward.z + x * frame.right.z) + y * frame.up.z;
    rays.length = sqrt(wide_inner(d, d));  // where d is at depth 1
    wide inverse = 1.0 / rays.length;
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
        rays.length = 1.0 / (d.x * frame.normal.x + d.y * frame.normal.y + d.z * frame.normal.z);
    }
    vec3 center = DOMAIN_CENTER;
    rays.eye = origin;
    rays.d = d;
    rays.shift = (center.x - origin.x) * d.x + (center.y - origin.y) * d.y + (center.z - origin.z) * d.z;
    rays.o.x = wide_advanced(origin.x, rays.shift, d.x);
    rays.o.y = wide_advanced(origin.y, rays.shift, d.y);
    rays.o.z = wide_advanced(origin.z, rays.shift, d.z);
    rays.base = (frame.normal.x * (frame.origin.x - rays.o.x) + frame.normal.y * (frame.origin.y - rays.o.y)
                 + frame.normal.z * (frame.origin.z - rays.o.z)) * rays.length;
    return rays;
}
