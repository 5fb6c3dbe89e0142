typedef float real;
// vec3 has four components, the last 0: Intel's compiler passes vectors of three wrongly to functions it does not
// inline.
typedef float4 vec3;
#define real(x) ((float)(x))
#define vec3(x, y, z) ((float4)(x, y, z, 0.0f))
#define UNIT_ROUNDOFF 5.9604644775390625e-8f
#define SPLITTER 4097.0f
#define REAL_INFINITY INFINITY
#define REAL_TINY 4.7019774032891500319e-38f
