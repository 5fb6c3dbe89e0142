// One instance of a surface or mesh. The rows map world to local coordinates; local lengths times `scale` are the
// world's. 32 floats, as harness.scenes.records.pack makes them.
struct Instance {
    vec4 row_x;
    vec4 row_y;
    vec4 row_z;
    vec4 lower_scale;
    vec4 upper_bounding;
    vec4 stretch_domain;
    vec4 colour_feature;
    vec4 parameters;
};
layout(std430, binding = 0) readonly buffer Instances { Instance instances[]; };

vec3 local_point(Instance at, vec3 world) {
    vec4 point = vec4(world, 1.0);
    return vec3(dot(at.row_x, point), dot(at.row_y, point), dot(at.row_z, point));
}

// A local vector in world coordinates: the rows are those of a rotation over the scale, so its inverse is the transpose.
vec3 world_vector(Instance at, vec3 local) {
    float square = at.lower_scale.w * at.lower_scale.w;
    return square * (local.x * at.row_x.xyz + local.y * at.row_y.xyz + local.z * at.row_z.xyz);
}

// The place in the picture of what stands at `offset` from the eye, in world coordinates.
vec4 clip_position(vec3 offset) {
    float s = dot(offset, forward);
    float z = window_depth(s);
    return vec4(dot(offset, right) / dot(right, right), dot(offset, up) / dot(up, up), (2.0 * z - 1.0) * s, s);
}
