// Returns corner k of the box; bit i of k says whether coordinate i is the upper one.
vec3 proxy_corner(int k, vec3 lower, vec3 upper, float radius, vec3 local_eye) {
    return vec3((k & 1) == 0 ? lower.x : upper.x, (k & 2) == 0 ? lower.y : upper.y, (k & 4) == 0 ? lower.z : upper.z);
}
