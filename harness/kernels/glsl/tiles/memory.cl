// What the work items of a group share; the entry reserves it.
#define lane_numbers work.numbers
#define lane_bits work.bits
#define MEET barrier(CLK_LOCAL_MEM_FENCE);
#define RESERVED __local real numbers[16 * (SURFACE_DEGREE + 1)]; __local int bits[16];
#define OWN_LANE ((int)get_local_id(0))
