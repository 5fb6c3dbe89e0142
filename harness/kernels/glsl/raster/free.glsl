// The numbers of an instance that differ from the others' in parameters or domain; surface sections read them by name.
flat in vec4 instance_lower;
flat in vec4 instance_upper;
flat in vec4 instance_parameters;
flat in float instance_bounding;
#define DOMAIN_LOWER instance_lower.xyz
#define DOMAIN_UPPER instance_upper.xyz
#define DOMAIN_CENTER (0.5 * (instance_lower.xyz + instance_upper.xyz))
#define DOMAIN_RADIUS instance_lower.w
#define FEATURE_RADIUS instance_upper.w
#define BOUNDING_RADIUS instance_bounding
