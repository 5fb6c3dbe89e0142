// The normal of a point in a triangle: its vertices' own, between them and of length 1 again.
vec3 mesh_normal(vec3 interpolated) {
    return unit_vector(interpolated);
}
