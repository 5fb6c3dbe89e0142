// Runs map_item on one row per work item: INPUTS reals in, OUTPUTS reals out. For probes and tests of the libraries.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input0 { real x[]; };
layout(std430, binding = 1) writeonly buffer Output0 { real y[]; };
uniform int nx;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= nx) return;
    real item[INPUTS];
    real result[OUTPUTS];
    for (int k = 0; k < INPUTS; k++) item[k] = x[i * INPUTS + k];
    map_item(item, result);
    for (int k = 0; k < OUTPUTS; k++) y[i * OUTPUTS + k] = result[k];
}
