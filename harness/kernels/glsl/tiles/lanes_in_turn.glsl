// A work item does a tile's sixteen lanes in turn, row by row.
#define OWN_LANE (4 * work.row + work.column)
#define EACH_LANE for (work.row = 0; work.row < 4; work.row++) for (work.column = 0; work.column < 4; work.column++)
#define FIRST_TURN (OWN_LANE == 0)
#define lane_row(name, k) name(k)
