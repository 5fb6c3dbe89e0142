// The instances differ in parameters or domain: passes those of each instance on to its fragments.
flat out vec4 instance_lower;
flat out vec4 instance_upper;
flat out vec4 instance_parameters;
flat out float instance_bounding;
void pass_on(Instance at) {
    instance_lower = vec4(at.lower_scale.xyz, at.stretch_domain.w);
    instance_upper = vec4(at.upper_bounding.xyz, at.colour_feature.w);
    instance_parameters = at.parameters;
    instance_bounding = at.upper_bounding.w;
}
