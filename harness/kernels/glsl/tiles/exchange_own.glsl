// No lane asks another one: a work item does a tile's lanes in turn, or each lane goes its own way.
#define EACH_LANE for (work.lane = 0; work.lane < 16; work.lane++)
#define FIRST_TURN (work.lane == 0)
#define most(v) (v)
#define least(v) (v)
#define all_bits(v) (v)
#define all_lanes(mask) (mask)
#define any_lane(mask) (mask)
#define first_lane_number(v) (v)
