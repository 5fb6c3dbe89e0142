// Error-free transforms: hi is the rounded result, and hi + lo is the exact one if nothing over- or underflows.
// Dekker 1971; Knuth 1969; Ogita, Rump, Oishi 2005. two_prod splits its factors, since fma does not fuse on every
// device.
STRUCT(Pair) struct Pair { real hi; real lo; };

Pair make_pair(real hi, real lo) {
    Pair pair;
    pair.hi = hi;
    pair.lo = lo;
    return pair;
}

Pair two_sum(real a, real b) {
    PRECISE real s = a + b;
    PRECISE real c = s - a;
    PRECISE real d = s - c;
    PRECISE real e = a - d;
    PRECISE real f = b - c;
    PRECISE real g = e + f;
    return make_pair(s, g);
}

Pair split(real a) {
    PRECISE real c = SPLITTER * a;
    PRECISE real d = c - a;
    PRECISE real hi = c - d;
    PRECISE real lo = a - hi;
    return make_pair(hi, lo);
}

Pair two_prod(real a, real b) {
    PRECISE real p = a * b;
    Pair x = split(a);
    Pair y = split(b);
    PRECISE real hh = x.hi * y.hi;
    PRECISE real hl = x.hi * y.lo;
    PRECISE real lh = x.lo * y.hi;
    PRECISE real ll = x.lo * y.lo;
    PRECISE real e1 = p - hh;
    PRECISE real e2 = e1 - hl;
    PRECISE real e3 = e2 - lh;
    PRECISE real e = ll - e3;
    return make_pair(p, e);
}
