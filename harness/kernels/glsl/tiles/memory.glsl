// What the work items of a group share.
#define lane_numbers shared_numbers
#define lane_bits shared_bits
#define MEET memoryBarrierShared(); barrier();
shared real shared_numbers[16 * (SURFACE_DEGREE + 1)];
shared int shared_bits[16];
#define OWN_LANE int(gl_LocalInvocationID.x)
