// The normal of the mesh that fingerprints draw.
vec3 mesh_normal(vec3 interpolated) {
    return unit_vector(interpolated);
}
