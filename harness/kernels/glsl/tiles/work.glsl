// The buffers that all stages share, and where lists lie in them; see work.cl.
#define LEFT 49
#define TAKEN 32
#define bit_count(v) bitCount(v)
layout(local_size_x = TILE_GROUP) in;
layout(std430, binding = 0) readonly buffer Camera { float camera[]; };
layout(std430, binding = 1) buffer Distances { real t[]; };
layout(std430, binding = 2) buffer Answers { int answer[]; };
layout(std430, binding = 3) buffer Queue { int queue[]; };
layout(std430, binding = 4) buffer Counts { int counts[]; };
layout(std430, binding = 5) buffer Entries { real entries[]; };
layout(std430, binding = 6) readonly buffer Fourths { real fourths[]; };
layout(std430, binding = 7) readonly buffer Rays { float rays[]; };
uniform int nx;
uniform int size;
uniform int tile;
uniform int level;
uniform int ratio;

// The lane that a work item has, or the row and column of that which it does in turn, and which of the `items` that take
// tiles it is, or its group.
struct Work { int size; int tile; int level; int ratio; int lane; int row; int column; int item; int items; };

// What an entry hands to a stage; TILE_ITEMS work items share a tile or a pixel.
#define WORK Work(size, tile, level, ratio, int(gl_GlobalInvocationID.x) % 16, 0, 0, \
                  int(gl_GlobalInvocationID.x) / TILE_ITEMS, int(gl_NumWorkGroups.x) * TILE_GROUP / TILE_ITEMS)

real camera_at(Work work, int place) { return real(camera[place]); }
int counted(Work work, int counter) { return counts[counter]; }
int queued(Work work, int place) { return queue[place]; }
real entry_at(Work work, int place) { return entries[place]; }
real fourth_at(Work work, int cell) { return fourths[cell]; }
real ray_at(Work work, int place) { return real(rays[place]); }
int next_in(Work work, int counter) { return atomicAdd(counts[counter], 1); }
void add_to(Work work, int counter, int value) { atomicAdd(counts[counter], value); }
void enqueue(Work work, int place, int value) { queue[place] = value; }
void enter(Work work, int place, real value) { entries[place] = value; }
void set_t(Work work, int place, real value) { t[place] = value; }
void set_answer(Work work, int place, int word) { answer[place] = word; }
int answered(Work work, int place) { return answer[place]; }

// Gives `count` neighbouring pixels of a row the same answer.
void set_answers(Work work, int place, int count, int word) {
    for (int k = 0; k < count; k++) answer[place + k] = word;
}
