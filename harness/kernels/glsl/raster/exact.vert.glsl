// The method's own tolerance, however far the instance.
void set_tolerance(Instance at, vec3 local_eye) {}
