#define EXCHANGED(v, exchange, bits) as_double((int2)(exchange(as_int2(v).x, bits), exchange(as_int2(v).y, bits)))
