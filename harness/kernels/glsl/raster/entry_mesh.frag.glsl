// Shades one fragment of a triangle by the normal that is interpolated between the mesh's vertices.
flat in vec3 instance_colour;
in vec3 offset;
in vec3 normal;
layout(location = 0) out vec4 picture;
void main() {
    picture = lit(instance_colour, mesh_normal(normal), unit_vector(offset));
}
