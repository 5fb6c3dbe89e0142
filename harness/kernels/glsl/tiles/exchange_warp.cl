// Sixteen work items of a warp share a tile, and exchange numbers without memory. Two tiles of a warp may be at different
// places of a kernel: each exchange is among the sixteen that have one tile. All of them must call it, or none.
#define EACH_LANE
#define FIRST_TURN true
#define least(v) (-most(-(v)))
#define any_lane(mask) (!all_lanes(!(mask)))
// Takes a place on a list, the same one for all lanes.
#define shared_place(work, counter) zeroth_word(LEADS ? next_in(work, counter) : 0, 0)
#define LEADS (OWN_LANE == 0)
#define first_lane(v) lane_zero(v)
#define first_lane_number(v) lane_zero(v)
#define OTHER_1(v) other_lane(v, 1)
#define OTHER_2(v) other_lane(v, 2)
#define OTHER_3(v) other_lane(v, 3)
#define OTHER_4(v) other_lane(v, 4)
#define OTHER_8(v) other_lane(v, 8)
#define OTHER_12(v) other_lane(v, 12)

#if defined(__NV_CL_C_VERSION) || defined(cl_nv_pragma_unroll)
// NVIDIA's compiler knows no such extension, but takes the instructions of its assembly language PTX.
uint own_half(void) { return 0xffffu << ((uint)get_local_id(0) & 16u); }
int other_word(int v, int bits) {
    int result;
    asm volatile("shfl.sync.bfly.b32 %0, %1, %2, 0x101f, %3;" : "=r"(result) : "r"(v), "r"(bits), "r"(own_half()));
    return result;
}
int zeroth_word(int v, int none) {
    int result;
    asm volatile("shfl.sync.idx.b32 %0, %1, 0, 0x101f, %2;" : "=r"(result) : "r"(v), "r"(own_half()));
    return result;
}
bool all_lanes(bool mask) {
    uint voted;
    asm volatile("{ .reg .pred p; setp.ne.s32 p, %1, 0; vote.sync.ballot.b32 %0, p, %2; }"
                 : "=r"(voted) : "r"(mask ? 1 : 0), "r"(own_half()));
    return voted == own_half();
}
#else
#define LANES_TOGETHER __attribute__((intel_reqd_sub_group_size(16)))
#pragma OPENCL EXTENSION cl_khr_subgroups : enable
#pragma OPENCL EXTENSION cl_khr_subgroup_shuffle : enable
int other_word(int v, int bits) { return sub_group_shuffle_xor(v, (uint)bits); }
int zeroth_word(int v, int none) { return sub_group_shuffle(v, 0u); }
bool all_lanes(bool mask) { return sub_group_all(mask) != 0; }
#endif

real other_lane(real v, int bits) { return EXCHANGED(v, other_word, bits); }
real lane_zero(real v) { return EXCHANGED(v, zeroth_word, 0); }

real most(real v) {
    real result = v;
    for (int bits = 1; bits < 16; bits *= 2) result = max(result, other_lane(result, bits));
    return result;
}

real total(real v) {
    real result = v;
    for (int bits = 1; bits < 16; bits *= 2) result += other_lane(result, bits);
    return result;
}

// Returns the bits that all lanes have.
int all_bits(int v) {
    int result = v;
    for (int bits = 1; bits < 16; bits *= 2) result = result & other_word(result, bits);
    return result;
}
