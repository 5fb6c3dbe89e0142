// For programs whose answers are checked: gives each turn of each loop an effect, so that no compiler may remove a
// loop, whether the loop ends or not. The effect stores nothing, and no answer depends on it. The `else` in the macro
// of `for` keeps the meaning of `if (a) for (…) b; else c`.
bool loop_is_kept() {
    memoryBarrierAtomicCounter();
    return true;
}
#define while(condition) while (loop_is_kept() && (condition))
#define for(head) for (head) if (!loop_is_kept()) {} else
