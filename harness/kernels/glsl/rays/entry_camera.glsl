// Casts the ray of one sample of a camera's image per work item. `c` is the camera: eye, forward, right, up, 12
// float32.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input0 { float c[]; };
layout(std430, binding = 1) writeonly buffer Output0 { real t[]; };
layout(std430, binding = 2) writeonly buffer Output1 { int answer[]; };
uniform int nx;
uniform int ny;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    int j = int(gl_GlobalInvocationID.y);
    if (i >= nx || j >= ny) return;
    Cast result = cast_ray(camera_ray(vec3(c[0], c[1], c[2]), vec3(c[3], c[4], c[5]), vec3(c[6], c[7], c[8]),
                                      vec3(c[9], c[10], c[11]), i, j, nx, ny));
    t[j * nx + i] = result.shift + result.hit.t;
    answer[j * nx + i] = packed_answer(result.hit);
}
