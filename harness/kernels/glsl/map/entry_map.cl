// Runs map_item on one row per work item: INPUTS reals in, OUTPUTS reals out. For probes and tests of the libraries.
__kernel void map(__global const real *x, __global real *y, int nx, int ny) {
    int i = get_global_id(0);
    if (i >= nx) return;
    real item[INPUTS];
    real result[OUTPUTS];
    for (int k = 0; k < INPUTS; k++) item[k] = x[i * INPUTS + k];
    map_item(item, result);
    for (int k = 0; k < OUTPUTS; k++) y[i * OUTPUTS + k] = result[k];
}
