// 16 independent chains of 4096 multiply-adds: 131072 operations per item, for the device's peak rate.
#define INPUTS 1
#define OUTPUTS 1
#define PEAK_OPERATIONS 131072
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    real a[16];
    for (int k = 0; k < 16; k++) a[k] = x[0] + real(k);
    for (int i = 0; i < 4096; i++) {
        for (int k = 0; k < 16; k++) a[k] = fma(a[k], real(0.999), real(0.001));
    }
    real sum = 0.0;
    for (int k = 0; k < 16; k++) sum += a[k];
    y[0] = sum;
}
