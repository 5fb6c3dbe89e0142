// A wide number is sixteen float64, and a mask sixteen int64, 0 or -1: one work item has all lanes.
typedef double16 wide;
typedef long16 yes;
#define int_lanes(v) convert_int16(v)
