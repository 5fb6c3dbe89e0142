// Sixteen work items, a work group, share a tile: they exchange numbers through local memory. All of them must call an
// exchange, or none.
#define LEADS (OWN_LANE == 0)
#define EACH_LANE
#define FIRST_TURN true
#define most(v) most_of(work, v)
#define total(v) total_of(work, v)
#define least(v) (-most_of(work, -(v)))
#define all_bits(v) all_bits_of(work, v)
#define all_lanes(mask) (all_bits((mask) ? 1 : 0) != 0)
#define any_lane(mask) (all_bits((mask) ? 0 : 1) == 0)
#define first_lane(v) other_lane(work, v, OWN_LANE)
#define first_lane_number(v) first_lane(v)
#define OTHER_1(v) other_lane(work, v, 1)
#define OTHER_2(v) other_lane(work, v, 2)
#define OTHER_3(v) other_lane(work, v, 3)
#define OTHER_4(v) other_lane(work, v, 4)
#define OTHER_8(v) other_lane(work, v, 8)
#define OTHER_12(v) other_lane(work, v, 12)

real most_of(Work work, real v) {
    lane_numbers[OWN_LANE] = v;
    MEET
    real result = lane_numbers[0];
    for (int k = 1; k < 16; k++) result = max(result, lane_numbers[k]);
    MEET
    return result;
}

real total_of(Work work, real v) {
    lane_numbers[OWN_LANE] = v;
    MEET
    real result = lane_numbers[0];
    for (int k = 1; k < 16; k++) result += lane_numbers[k];
    MEET
    return result;
}

// Returns the bits that all lanes have.
int all_bits_of(Work work, int bits) {
    lane_bits[OWN_LANE] = bits;
    MEET
    int result = lane_bits[0];
    for (int k = 1; k < 16; k++) result = result & lane_bits[k];
    MEET
    return result;
}

// Returns the number of the lane whose index differs in these bits.
real other_lane(Work work, real v, int bits) {
    lane_numbers[OWN_LANE] = v;
    MEET
    real result = lane_numbers[OWN_LANE ^ bits];
    MEET
    return result;
}

// Takes a place on a list, the same one for all lanes.
int shared_place(Work work, int counter) {
    if (LEADS) lane_bits[0] = next_in(work, counter);
    MEET
    int place = lane_bits[0];
    MEET
    return place;
}
