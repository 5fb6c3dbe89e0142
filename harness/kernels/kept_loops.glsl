// For programs whose answers are checked: each turn of each loop has an effect, so that no compiler may remove the loop,
// whether it ends or not. Nothing is stored, and no answer depends on it. `else` keeps `if (a) for (…) b; else c` right.
bool turned() {
    memoryBarrierAtomicCounter();
    return true;
}
#define while(condition) while (turned() && (condition))
#define for(head) for (head) if (!turned()) {} else
