typedef float real;
typedef float3 vec3;
#define real(x) ((float)(x))
#define vec3(x, y, z) ((float3)(x, y, z))
#define UNIT_ROUNDOFF 5.9604644775390625e-8f
#define SPLITTER 4097.0f
#define REAL_INFINITY INFINITY
#define REAL_TINY 4.7019774032891500319e-38f
