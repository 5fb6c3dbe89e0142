// All instances have the same surface, whose numbers are constants of the program: nothing is passed to the fragments.
void pass_on(Instance at) {}
