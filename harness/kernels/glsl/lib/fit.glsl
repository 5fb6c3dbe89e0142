// Compensated sums of products for fitting (szente, section 2.1; Ogita, Rump, Oishi 2005, Dot2). Matrix entries and
// samples are given in two parts, and every product and sum keeps its rounding error.
STRUCT(Factor) struct Factor { real hi; real lo; real head; real tail; };  // value hi + lo; hi is head + tail exactly

Factor make_factor(Pair value) {
    Pair parts = split(value.hi);
    Factor factor;
    factor.hi = value.hi;
    factor.lo = value.lo;
    factor.head = parts.hi;
    factor.tail = parts.lo;
    return factor;
}

// Returns sum + (hi + lo) b to about twice the working precision.
Pair plus_product(Pair sum, real hi, real lo, Factor b) {
    Pair a = split(hi);
    PRECISE real p = hi * b.hi;
    PRECISE real hh = a.hi * b.head;
    PRECISE real hl = a.hi * b.tail;
    PRECISE real lh = a.lo * b.head;
    PRECISE real ll = a.lo * b.tail;
    PRECISE real e1 = p - hh;
    PRECISE real e2 = e1 - hl;
    PRECISE real e3 = e2 - lh;
    PRECISE real error = ll - e3;
    Pair total = two_sum(sum.hi, p);
    PRECISE real rest = hi * b.lo + lo * b.hi;
    PRECISE real low = sum.lo + (total.lo + (error + rest));
    return make_pair(total.hi, low);
}
