#version 430
// The common shading subset, as GLSL. Array parameters are marked IN, OUT or INOUT; all else goes by value.
#define fabs abs
#define IN const in
#define OUT out
#define INOUT inout
#define PRECISE precise
#define TABLE const
#define STRUCT(T)
