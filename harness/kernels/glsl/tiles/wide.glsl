// Vectors and spans of one value per lane, and matrices that mix the lanes of a tile.
STRUCT(WideVec3) struct WideVec3 { wide x; wide y; wide z; };
STRUCT(WideRay) struct WideRay { WideVec3 origin; WideVec3 direction; };
STRUCT(WideSpan) struct WideSpan { wide lo; wide hi; };

// Returns o + t d; t is one number, or one per lane.
WideVec3 wide_point(WideVec3 o, wide t, WideVec3 d) {
    WideVec3 p;
    p.x = FUSED(t, d.x, o.x);
    p.y = FUSED(t, d.y, o.y);
    p.z = FUSED(t, d.z, o.z);
    return p;
}

wide wide_inner(WideVec3 a, WideVec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// A 4 by 4 matrix as each lane sees it: what it takes from the lanes beside it (u) and above it (v), see _lane_tables.
STRUCT(Rows) struct Rows { wide u0; wide u1; wide u2; wide u3; wide v0; wide v1; wide v2; wide v3; };

#define MAKE_ROWS(r, name) { r.u0 = lane_row(name, 0); r.u1 = lane_row(name, 1); r.u2 = lane_row(name, 2); \
    r.u3 = lane_row(name, 3); r.v0 = lane_row(name, 4); r.v1 = lane_row(name, 5); r.v2 = lane_row(name, 6); \
    r.v3 = lane_row(name, 7); }

// Applies a matrix whose rows have the sum 1, by differences, whose rounding errors are small where lanes agree.
#define TRANSFORM_ONE(g, r) { \
    wide h_ = g + FUSED(r.u3, OTHER_3(g) - g, FUSED(r.u2, OTHER_2(g) - g, r.u1 * (OTHER_1(g) - g))); \
    g = h_ + FUSED(r.v3, OTHER_12(h_) - h_, FUSED(r.v2, OTHER_8(h_) - h_, r.v1 * (OTHER_4(h_) - h_))); }

// Applies any matrix.
#define TRANSFORM_ANY(g, r) { \
    wide h_ = r.u0 * g + r.u1 * OTHER_1(g) + r.u2 * OTHER_2(g) + r.u3 * OTHER_3(g); \
    g = r.v0 * h_ + r.v1 * OTHER_4(h_) + r.v2 * OTHER_8(h_) + r.v3 * OTHER_12(h_); }
