#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
// vec3 has four components, the last 0: Intel's compiler passes vectors of three wrongly to functions it does not
// inline.
typedef double4 vec3;
#define real(x) ((double)(x))
#define vec3(x, y, z) ((double4)(x, y, z, 0.0))
#define UNIT_ROUNDOFF 1.1102230246251565404e-16
#define SPLITTER 134217729.0
#define REAL_INFINITY ((double)INFINITY)
#define REAL_TINY 8.9002954340288055324e-308
