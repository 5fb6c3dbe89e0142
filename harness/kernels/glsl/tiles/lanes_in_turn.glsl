// A work item does a tile's sixteen lanes in turn, row by row. Mesa unrolls loops that are short, or that index an array
// which has as many numbers as they have turns; so no array is indexed by a row or column.
#define EACH_LANE for (work.row = 0; work.row < 4; work.row++) for (work.column = 0; work.column < 4; work.column++)
#define FIRST_TURN (OWN_LANE == 0)
#undef OWN_LANE
#define OWN_LANE (4 * work.row + work.column)
#undef lane_row
#define lane_row(name, k) name(k)
