// Arithmetic on numbers that are sums of two, to about twice the working precision. After Dekker 1971; M. Joldes,
// J.-M. Muller, V. Popescu, Tight and rigorous error bounds for basic building blocks of double-word arithmetic, 2017
// (algorithms 6, 9, 12 and 17, with products by splitting).

// Returns a + b exactly, if |a| >= |b|.
Pair quick_two_sum(real a, real b) {
    PRECISE real s = a + b;
    PRECISE real c = s - a;
    PRECISE real e = b - c;
    return make_pair(s, e);
}

Pair pair_sum(Pair a, Pair b) {
    Pair s = two_sum(a.hi, b.hi);
    Pair e = two_sum(a.lo, b.lo);
    PRECISE real c = s.lo + e.hi;
    Pair v = quick_two_sum(s.hi, c);
    PRECISE real w = e.lo + v.lo;
    return quick_two_sum(v.hi, w);
}

Pair pair_scaled(Pair a, real b) {
    Pair p = two_prod(a.hi, b);
    PRECISE real low = a.lo * b;
    PRECISE real rest = p.lo + low;
    return quick_two_sum(p.hi, rest);
}

Pair pair_product(Pair a, Pair b) {
    Pair p = two_prod(a.hi, b.hi);
    PRECISE real ab = a.hi * b.lo;
    PRECISE real ba = a.lo * b.hi;
    PRECISE real cross = ab + ba;
    PRECISE real rest = p.lo + cross;
    return quick_two_sum(p.hi, rest);
}

Pair pair_negative(Pair a) {
    return make_pair(-a.hi, -a.lo);
}

Pair pair_quotient(Pair a, Pair b) {
    PRECISE real first = a.hi / b.hi;
    Pair rest = pair_sum(a, pair_negative(pair_scaled(b, first)));
    PRECISE real second = rest.hi / b.hi;
    return quick_two_sum(first, second);
}
