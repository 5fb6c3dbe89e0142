#define real float
#define UNIT_ROUNDOFF 5.9604644775390625e-8
#define SPLITTER 4097.0
#define REAL_INFINITY uintBitsToFloat(0x7f800000u)
