// One instance of a surface or mesh: 32 floats, as harness.scenes.records.pack makes them. The rows map world
// coordinates to local ones; a local length times `scale` is the length in the world.
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

// Turns a local vector into world coordinates. The rows are a rotation's divided by the scale, so that their transpose
// times the squared scale is the inverse.
vec3 world_vector(Instance at, vec3 local) {
    float square = at.lower_scale.w * at.lower_scale.w;
    return square * (local.x * at.row_x.xyz + local.y * at.row_y.xyz + local.z * at.row_z.xyz);
}

// Returns the place in the picture, in clip coordinates, of the point at `offset` from the eye, in world coordinates.
vec4 clip_position(vec3 offset) {
    float s = dot(offset, forward);
    float z = window_depth(s);
    return vec4(dot(offset, right) / dot(right, right), dot(offset, up) / dot(up, up), (2.0 * z - 1.0) * s, s);
}
