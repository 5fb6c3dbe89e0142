// Returns the normal at a point of a triangle: what is interpolated from its vertices' normals, with length 1 again.
vec3 mesh_normal(vec3 interpolated) {
    return unit_vector(interpolated);
}
