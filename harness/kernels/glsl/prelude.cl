// Defines the common shading subset in OpenCL C. Array parameters are marked IN, OUT or INOUT; all others go by value.
#pragma OPENCL FP_CONTRACT OFF
#define int(x) ((int)(x))
#define IN const
#define OUT
#define INOUT
#define PRECISE
#define TABLE __constant
#define STRUCT(T) typedef struct T T;
