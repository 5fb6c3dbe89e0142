// Casts the ray of one sample of a camera's image per work item. `c` is the camera: eye, forward, right, up, 12 float32;
// forward has length 1, right and up are half the sides of the image at the distance 1. It writes for each ray:
// t         the distance of the hit from the eye
// answer    evaluations of f * 4 + status; status 0: a miss, 1: a hit, 2: given up; the word -1: no answer
// normals   the unit vector along the gradient of f at the hit, 3 float32; zeros without a hit
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input0 { float c[]; };
layout(std430, binding = 1) writeonly buffer Output0 { real t[]; };
layout(std430, binding = 2) writeonly buffer Output1 { int answer[]; };
layout(std430, binding = 3) writeonly buffer Output2 { float normals[]; };
uniform int nx;
uniform int ny;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    int j = int(gl_GlobalInvocationID.y);
    if (i >= nx || j >= ny) return;
    int k = j * nx + i;
    Ray ray = camera_ray(vec3(c[0], c[1], c[2]), vec3(c[3], c[4], c[5]), vec3(c[6], c[7], c[8]),
                         vec3(c[9], c[10], c[11]), i, j, nx, ny);
    Cast result = cast_ray(ray);
    vec3 normal = vec3(0.0, 0.0, 0.0);
    if (result.hit.status == HIT) normal = surface_normal(ray_point(advanced_ray(ray, result.shift), result.hit.t));
    t[k] = result.shift + result.hit.t;
    answer[k] = packed_answer(result.hit);
    normals[3 * k] = float(normal.x);
    normals[3 * k + 1] = float(normal.y);
    normals[3 * k + 2] = float(normal.z);
}
