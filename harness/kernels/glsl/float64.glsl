#define real double
#define vec3 dvec3
#define UNIT_ROUNDOFF 1.1102230246251565404e-16lf
#define SPLITTER 134217729.0lf
#define REAL_INFINITY packDouble2x32(uvec2(0u, 0x7ff00000u))
#define REAL_TINY 8.9002954340288055324e-308lf
