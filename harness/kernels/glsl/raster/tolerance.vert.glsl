// Sets the tolerance to PIXELS times the height that a pixel shows at the distance of the domain's middle, in local
// units.
flat out float instance_tolerance;
void set_tolerance(Instance at, vec3 local_eye) {
    vec3 middle = 0.5 * (at.lower_scale.xyz + at.upper_bounding.xyz);
    instance_tolerance = PIXELS * 2.0 * length(up) / float(size) * distance(local_eye, middle);
}
