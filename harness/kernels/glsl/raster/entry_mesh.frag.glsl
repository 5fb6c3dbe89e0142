// One fragment of a triangle, shaded by the normal that the mesh's vertices give it.
flat in vec3 instance_colour;
in vec3 offset;
in vec3 normal;
layout(location = 0) out vec4 picture;
void main() {
    picture = lit(instance_colour, mesh_normal(normal), unit_vector(offset));
}
