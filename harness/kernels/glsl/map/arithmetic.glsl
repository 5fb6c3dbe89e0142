// Shows how a device rounds and rearranges: harness/devices/fingerprint.py hashes what it answers, part by part.
// x[0] to x[3] are any numbers, special ones included. Sums and products stand without PRECISE, as methods write them,
// so that a compiler shows what it makes of them; y[33] and what follows stand with it.
#define INPUTS 4
#define OUTPUTS 44

// Returns x between -limit and limit, and 0 where it is no number.
real within(real x, real limit) {
    return fabs(x) < limit ? x : real(0);
}

void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    real a = x[0];
    real b = x[1];
    real c = x[2];
    real d = x[3];
    // sums: 3
    y[0] = a + b;
    y[1] = a - b;
    y[2] = c + 0.5;
    // products: 2
    y[3] = a * b;
    y[4] = c * c;
    // quotients: 3
    y[5] = a / b;
    y[6] = 1.0 / c;
    y[7] = d / 3.0;
    // roots: 3
    y[8] = sqrt(a);
    y[9] = sqrt(fabs(b));
    y[10] = 1.0 / sqrt(fabs(c));
    // conversions: 4
    // a float is made of an int by what both languages allow
    int whole = int(within(a, real(1073741824)));
    int any = int(within(b, real(1048576)) * 1024.0);
    float narrow = any;
    y[11] = real(whole);
    y[12] = real(any);
    y[13] = real(any - whole / 3);
    y[14] = narrow;
    // denormals: 5
    real small = within(a, real(4)) * (REAL_TINY * 0.0625);
    real smaller = within(b, real(4)) * (REAL_TINY * 0.0009765625);
    y[15] = small;
    y[16] = small - smaller;
    y[17] = smaller * 1048576.0;
    y[18] = small / smaller;
    y[19] = sqrt(fabs(smaller)) + (smaller > 0.0 ? real(1) : real(2));
    // selection: 6
    y[20] = min(a, b);
    y[21] = max(a, b);
    y[22] = clamp(a, -fabs(c), fabs(c));
    y[23] = floor(within(d, real(4194304)));
    y[24] = ceil(within(d, real(4194304))) - sign(b);
    y[25] = a < b ? -c : (a == b ? fabs(c) : d);
    // fma: 1
    y[26] = fma(a, b, c);
    // contraction: 3
    y[27] = a * b + c;
    y[28] = a * b - c * d;
    y[29] = d - a * b;
    // rearrangement: 3
    y[30] = a + b + c;
    y[31] = a * c + b * c;
    y[32] = (a + b) - a;
    // exact: 6
    PRECISE real product = a * b;
    PRECISE real sum = product + c;
    PRECISE real three = a + b;
    PRECISE real all_three = three + c;
    Pair error = two_sum(a, b);
    Pair rest = two_prod(a, b);
    y[33] = sum;
    y[34] = all_three;
    y[35] = error.hi;
    y[36] = error.lo;
    y[37] = rest.hi;
    y[38] = rest.lo;
    // vectors: 5
    vec3 p = vec3(a, b, c);
    vec3 q = vec3(d, a, b);
    vec3 n = unit_vector(p);
    y[39] = inner_product(p, q);
    y[40] = dot(p, q);
    y[41] = n.x;
    y[42] = length(q) + cross(p, q).y;
    y[43] = normalize(p).z;
}
