// Stretches a vertex of the mesh along the axes and moves it to its instance's place.
in vec3 vertex_position;
in vec3 vertex_normal;
flat out int instance;
flat out vec3 instance_colour;
out vec3 offset;
out vec3 normal;
void main() {
    Instance at = instances[gl_InstanceID];
    instance = gl_InstanceID;
    instance_colour = at.colour_feature.xyz;
    offset = world_vector(at, vertex_position * at.stretch_domain.xyz - local_point(at, eye));
    normal = world_vector(at, vertex_normal / at.stretch_domain.xyz);
    gl_Position = clip_position(offset);
}
