// Runs stage 2 on the single tiles of one level.
void main() {
    Work work = WORK;
    finish_tiles(work, make_frame(work));
}
