// No lane asks another one: a work item does a tile's lanes in turn, or each lane goes its own way.
#define most(v) (v)
#define total(v) (v)
#define least(v) (v)
#define all_bits(v) (v)
#define all_lanes(mask) (mask)
#define any_lane(mask) (mask)
#define first_lane_number(v) (v)
