// Returns corner k of the smallest tetrahedron about the box, which has 4.5 times its volume: three of its planes hold
// faces of the box, and the fourth goes through the opposite corner.
vec3 proxy_corner(int k, vec3 lower, vec3 upper, float radius, vec3 local_eye) {
    vec3 reach = 3.0 * (upper - lower);
    return lower + vec3(k == 1 ? reach.x : 0.0, k == 2 ? reach.y : 0.0, k == 3 ? reach.z : 0.0);
}
