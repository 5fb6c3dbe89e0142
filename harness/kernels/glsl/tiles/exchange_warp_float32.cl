#define EXCHANGED(v, exchange, bits) as_float(exchange(as_int(v), bits))
