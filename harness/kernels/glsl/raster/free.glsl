// Names the numbers of the fragment's instance where instances differ in parameters or domain. The generated
// functions of the surface read them by these names, which are constants elsewhere.
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
