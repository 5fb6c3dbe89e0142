// Runs the last stage; level is the number of levels.
__kernel void rest(TAKES) {
    RESERVED
    Work work = WORK;
    cast_left(work);
}
