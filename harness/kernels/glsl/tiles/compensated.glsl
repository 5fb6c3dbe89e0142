// Compensated arithmetic: numbers as a rounded value `hi` and the error `lo` of that value, which is itself rounded.
// Sums and products keep the errors of their values exactly and carry those of their operands to first order, as in Ogita,
// Rump, Oishi 2005 and in the compensated Horner scheme of Langlois and Louvet 2007. So the results of polynomials are
// about as good as those of twice the precision.
STRUCT(WidePair) struct WidePair { wide hi; wide lo; };

WidePair wide_pair(wide hi, wide lo) {
    WidePair pair;
    pair.hi = hi;
    pair.lo = lo;
    return pair;
}

// Returns the sum of two numbers and its error.
WidePair wide_two_sum(wide a, wide b) {
    PRECISE wide s = a + b;
    PRECISE wide c = s - a;
    PRECISE wide d = s - c;
    PRECISE wide e = a - d;
    PRECISE wide f = b - c;
    PRECISE wide g = e + f;
    return wide_pair(s, g);
}

// Returns the product of two numbers and its error.
WidePair wide_two_prod(wide a, wide b) {
    PRECISE wide p = a * b;
    return wide_pair(p, PRODUCT_ERROR(a, b, p));
}

WidePair wide_sum(WidePair a, WidePair b) {
    WidePair s = wide_two_sum(a.hi, b.hi);
    return wide_pair(s.hi, s.lo + (a.lo + b.lo));
}

WidePair wide_difference(WidePair a, WidePair b) {
    WidePair s = wide_two_sum(a.hi, -b.hi);
    return wide_pair(s.hi, s.lo + (a.lo - b.lo));
}

WidePair wide_product(WidePair a, WidePair b) {
    WidePair p = wide_two_prod(a.hi, b.hi);
    return wide_pair(p.hi, FUSED(a.hi, b.lo, FUSED(a.lo, b.hi, p.lo)));
}

WidePair wide_square(WidePair a) {
    WidePair p = wide_two_prod(a.hi, a.hi);
    return wide_pair(p.hi, FUSED(2.0 * a.hi, a.lo, p.lo));
}

// Returns a + c and c a for a number c without an error, and c a for a power of two.
WidePair wide_shifted(WidePair a, real c) {
    WidePair s = wide_two_sum(a.hi, wide(c));
    return wide_pair(s.hi, s.lo + a.lo);
}

WidePair wide_scaled(WidePair a, real c) {
    WidePair p = wide_two_prod(a.hi, wide(c));
    return wide_pair(p.hi, FUSED(a.lo, wide(c), p.lo));
}

WidePair wide_doubled(WidePair a, real c) {
    return wide_pair(c * a.hi, c * a.lo);
}

// A point whose coordinates are such numbers.
STRUCT(WidePairs) struct WidePairs { WidePair x; WidePair y; WidePair z; };

// Returns o + t d, where o and t d may be far larger than their sum.
WidePair wide_far_coordinate(wide o, wide t, wide d) {
    WidePair product = wide_two_prod(t, d);
    WidePair sum = wide_two_sum(o, product.hi);
    WidePair whole = wide_two_sum(sum.hi, product.lo);
    return wide_two_sum(whole.hi, whole.lo + sum.lo);
}

WidePairs wide_far_point(WideVec3 o, wide t, WideVec3 d) {
    WidePairs p;
    p.x = wide_far_coordinate(o.x, t, d.x);
    p.y = wide_far_coordinate(o.y, t, d.y);
    p.z = wide_far_coordinate(o.z, t, d.z);
    return p;
}
