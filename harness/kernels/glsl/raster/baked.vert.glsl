// Every instance is of one surface, whose numbers are constants of the program.
void pass_on(Instance at) {}
