// A tile's polynomials where one work item has all sixteen: halving works on three that bound them. `lo` and `hi` have
// the least and the largest of their coefficients, and `fall` the largest of the differences of neighbouring ones. All
// three bound the halves too, since halving takes means.
// llvmpipe takes a private array's numbers one by one for each lane of its vectors, unless all its indices are known to
// the compiler, and its compiler takes long for long programs. So nothing here is an array: loops over rows and columns
// see the net as a queue. A turn of the first loop fits a row of nodes and transforms it across; one of the second
// transforms a column downwards and bounds it.
STRUCT(NetRow) struct NetRow { Poly c0; Poly c1; Poly c2; Poly c3; };
STRUCT(Net) struct Net { NetRow r0; NetRow r1; NetRow r2; NetRow r3; Poly first; };
STRUCT(Lanes) struct Lanes {
    real v0; real v1; real v2; real v3; real v4; real v5; real v6; real v7;
    real v8; real v9; real v10; real v11; real v12; real v13; real v14; real v15;
};
STRUCT(Bundle) struct Bundle { Poly lo; Poly hi; Poly fall; };
#define EACH_ROW for (work.row = 0; work.row < 4; work.row++)
#define EACH_COLUMN for (work.column = 0; work.column < 4; work.column++)
#define BEGIN_ROW(net) net.r0 = net.r1; net.r1 = net.r2; net.r2 = net.r3;
#define KEEP_LANE(net, p) { NEXT_COLUMN(net.r3) net.r3.c3 = p; }
#define END_ROW(net) ACROSS(net.r3)
#define RAISE_SPREAD(net, p, spread) { if (FIRST_TURN) net.first = p; FARTHER(net.first, p, spread) }
// Where all numbers of a coefficient are NaN, its bounds stay infinite: so does the error bound, and nothing is certain.
#define BUNDLED(net, b) { \
    CONSTANT(b.lo, REAL_INFINITY) \
    CONSTANT(b.hi, -REAL_INFINITY) \
    b.fall = b.hi; \
    EACH_COLUMN { \
        WIDEN(net, b) \
        NEXT_COLUMN(net.r0) NEXT_COLUMN(net.r1) NEXT_COLUMN(net.r2) NEXT_COLUMN(net.r3) \
    } \
}
#define NEXT_COLUMN(row) row.c0 = row.c1; row.c1 = row.c2; row.c2 = row.c3;
#define HALVE_BUNDLE(near, far) { HALVE(near.lo, far.lo) HALVE(near.hi, far.hi) HALVE_FALL(near.fall, far.fall) }
#define LARGEST_IN(b) max(LARGEST(b.lo), LARGEST(b.hi))
#define ALL_ABOVE(b, e) (LEAST(b.lo) > e)
#define CROSSES(b, e) (LAST(b.hi) < -e && FIRST(b.lo) > e)
#define FALLS(b, e) (LARGEST_FALL(b.fall) < -2.0 * e)
// Far halves are not kept: a piece is made anew from the whole one, by the halvings that lead to it.
STRUCT(Stack) struct Stack { Bundle whole; int depth; };
#define STACK(stack) Stack stack;
#define HOLD(stack, bundle) { stack.whole = bundle; stack.depth = 0; }
#define GO_TO_PIECE(stack, bundle, far, path, depth) \
    if (stack.depth < depth) { \
        HALVE_BUNDLE(bundle, far) \
        stack.depth += 1; \
        if (((path >> (depth - stack.depth)) & 1) == 1) bundle = far; \
        if (stack.depth < depth) continue; \
    }
#define HALVE_PIECE(stack, bundle, far, depth)
#define TAKE_PIECE(stack, bundle, depth) { bundle = stack.whole; stack.depth = 0; }
