// A tile's polynomials where one work item has all sixteen: halving works on three that bound them. `lo` and `hi` have
// the least and the largest of their coefficients, and `fall` the largest of the differences of neighbouring ones. All
// three bound the halves too, since halving takes means.
STRUCT(Net) struct Net { real v[16 * (SURFACE_DEGREE + 1)]; };
STRUCT(Lanes) struct Lanes { real v[16]; };
STRUCT(Bundle) struct Bundle { Poly lo; Poly hi; Poly fall; };
#define KEEP_NUMBER(lanes, number) { lanes.v[work.lane] = number; }
#define RAISE_NUMBER(lanes, number) { lanes.v[work.lane] = max(lanes.v[work.lane], number); }
#define NUMBER(lanes) lanes.v[work.lane]
#define HALVE_BUNDLE(near, far) { HALVE(near.lo, far.lo) HALVE(near.hi, far.hi) HALVE_FALL(near.fall, far.fall) }
#define LARGEST_IN(b) max(LARGEST(b.lo), LARGEST(b.hi))
#define ALL_ABOVE(b, e) (LEAST(b.lo) > e)
#define CROSSES(b, e) (LAST(b.hi) < -e && FIRST(b.lo) > e)
#define FALLS(b, e) (LARGEST_FALL(b.fall) < -2.0 * e)
