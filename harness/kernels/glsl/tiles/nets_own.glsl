// A tile's polynomials where one work item has all sixteen: halving works on three that bound them. `lo` and `hi` have
// the least and the largest of their coefficients, and `fall` the largest of the differences of neighbouring ones. All
// three bound the halves too, since halving takes means.
// llvmpipe takes a private array's numbers one by one for each lane of its vectors, unless all its indices are known to
// the compiler. So a net is a queue of rows, whose columns are known (lanes_in_turn.glsl), and Lanes is no array.
STRUCT(NetRow) struct NetRow { Poly c[4]; };
STRUCT(Net) struct Net { NetRow r0; NetRow r1; NetRow r2; NetRow r3; };
STRUCT(Lanes) struct Lanes {
    real v0; real v1; real v2; real v3; real v4; real v5; real v6; real v7;
    real v8; real v9; real v10; real v11; real v12; real v13; real v14; real v15;
};
STRUCT(Bundle) struct Bundle { Poly lo; Poly hi; Poly fall; };
#define KEEP_LANE(net, p) { \
    if (work.column == 0) { net.r0 = net.r1; net.r1 = net.r2; net.r2 = net.r3; } \
    net.r3.c[work.column] = p; }
#define RAISE_NUMBER(lanes, number) KEEP_NUMBER(lanes, max(NUMBER(lanes), number))
#define HALVE_BUNDLE(near, far) { HALVE(near.lo, far.lo) HALVE(near.hi, far.hi) HALVE_FALL(near.fall, far.fall) }
#define LARGEST_IN(b) max(LARGEST(b.lo), LARGEST(b.hi))
#define ALL_ABOVE(b, e) (LEAST(b.lo) > e)
#define CROSSES(b, e) (LAST(b.hi) < -e && FIRST(b.lo) > e)
#define FALLS(b, e) (LARGEST_FALL(b.fall) < -2.0 * e)
