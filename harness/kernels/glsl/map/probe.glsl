// Shows a device's arithmetic: two_sum and two_prod of two numbers, the error of a product by fma, and a quotient.
#define INPUTS 2
#define OUTPUTS 6
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    Pair sum = two_sum(x[0], x[1]);
    Pair product = two_prod(x[0], x[1]);
    PRECISE real p = x[0] * x[1];
    y[0] = sum.hi;
    y[1] = sum.lo;
    y[2] = product.hi;
    y[3] = product.lo;
    y[4] = fma(x[0], x[1], -p);
    y[5] = x[0] / x[1];
}
