#version 430
// Defines the common shading subset in GLSL. Array parameters are marked IN, OUT or INOUT; all others go by value.
#define fabs abs
#define IN const in
#define OUT out
#define INOUT inout
#define PRECISE precise
#define TABLE const
#define STRUCT(T)
