// Runs stage 3 on the open tiles of the last level; nothing if the last stage casts their pixels.
void main() {
    Work work = WORK;
    if (OPEN_TILES == 0) cast_packets(work, make_frame(work));
}
