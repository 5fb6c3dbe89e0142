// Places one corner of an instance's proxy, and passes on what its fragments need of the instance.
flat out int instance;
flat out vec3 instance_eye;
flat out vec3 instance_row_x;
flat out vec3 instance_row_y;
flat out vec3 instance_row_z;
flat out vec4 instance_colour_scale;
void main() {
    Instance at = instances[gl_InstanceID];
    instance = gl_InstanceID;
    instance_eye = local_point(at, eye);
    float scale = at.lower_scale.w;
    instance_row_x = scale * at.row_x.xyz;
    instance_row_y = scale * at.row_y.xyz;
    instance_row_z = scale * at.row_z.xyz;
    instance_colour_scale = vec4(at.colour_feature.xyz, scale);
    pass_on(at);
    set_tolerance(at, instance_eye);
    vec3 corner = proxy_corner(gl_VertexID, at.lower_scale.xyz, at.upper_bounding.xyz, at.upper_bounding.w, instance_eye);
    gl_Position = clip_position(world_vector(at, corner - instance_eye));
}
