#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double3 vec3;
#define real(x) ((double)(x))
#define vec3(x, y, z) ((double3)(x, y, z))
#define UNIT_ROUNDOFF 1.1102230246251565404e-16
#define SPLITTER 134217729.0
#define REAL_INFINITY ((double)INFINITY)
#define REAL_TINY 8.9002954340288055324e-308
