// Whether the driver has ended the shader's loops: Mesa's llvmpipe does, all at once, when they have turned 65,535 times
// together, and then lets each loop turn once more. `some`, at least 1, is not known to the compiler, so that it keeps
// the loop.
bool loops_were_ended(int some) {
    int wanted = min(some, 1) + 1;
    int turns = 0;
    while (turns < wanted) turns += 1;
    return turns < wanted;
}
