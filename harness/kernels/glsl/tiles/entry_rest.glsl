// Runs the last stage; level is the number of levels.
void main() {
    Work work = WORK;
    cast_left(work);
}
