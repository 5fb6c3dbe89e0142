// A work item does a tile's sixteen lanes in turn, row by row. Mesa unrolls the loop over columns where an array of four
// is indexed by the column, and no longer loop.
#define EACH_LANE for (work.row = 0; work.row < 4; work.row++) for (work.column = 0; work.column < 4; work.column++)
#define FIRST_TURN (OWN_LANE == 0)
#undef OWN_LANE
#define OWN_LANE (4 * work.row + work.column)
#undef lane_row
#define lane_row(name, k) name(k)
