// Runs stage 1 on the tiles of one level; at level -1, sets all counts to 0.
void main() {
    Work work = WORK;
    if (level < 0) {
        if (gl_GlobalInvocationID.x == 0) for (int k = 0; k < 64; k++) counts[k] = 0;
        return;
    }
    isolate_tiles(work, make_frame(work));
}
