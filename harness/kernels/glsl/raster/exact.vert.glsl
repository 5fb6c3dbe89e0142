// The method keeps its own tolerance, however far the instance is: nothing is set.
void set_tolerance(Instance at, vec3 local_eye) {}
