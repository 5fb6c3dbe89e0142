// A wide number is sixteen float32, and a mask sixteen int32, 0 or -1: one work item has all lanes.
typedef float16 wide;
typedef int16 yes;
#define int_lanes(v) convert_int16(v)
