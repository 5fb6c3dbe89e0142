// Returns whether the driver has ended the shader's loops. Mesa's llvmpipe ends all loops at once when they have turned
// 65,535 times together, and after that lets each loop turn once only; so a loop of two turns shows it. `some` is any
// number from 1 that the compiler does not know, so that it cannot replace this loop by its result.
bool loops_were_ended(int some) {
    int wanted = min(some, 1) + 1;
    int turns = 0;
    while (turns < wanted) turns += 1;
    return turns < wanted;
}
