// For programs whose answers are checked: each turn of each loop has an effect, so that no compiler may remove the loop,
// whether it ends or not. Nothing is stored, and no answer depends on it. `else` keeps `if (a) for (…) b; else c` right.
bool loop_is_kept() {
    memoryBarrierAtomicCounter();
    return true;
}
#define while(condition) while (loop_is_kept() && (condition))
#define for(head) for (head) if (!loop_is_kept()) {} else
