// What every shader of a frame knows of its camera: eye, forward, right and up, as camera_ray takes them;
// `depth_map`, the a and b of the depth buffer's value a + b / s at depth s along `forward`; and `size`, the pixels
// of a side.
uniform vec3 eye;
uniform vec3 forward;
uniform vec3 right;
uniform vec3 up;
uniform vec2 depth_map;
uniform int size;

float window_depth(float s) {
    return depth_map.x + depth_map.y / s;
}
