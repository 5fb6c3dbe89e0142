// What every shader of a frame knows of its camera: eye, forward, right, up as camera_ray takes them, the two numbers
// that turn a depth s along `forward` into the depth buffer's a + b / s; and how many pixels a side has.
uniform vec3 eye;
uniform vec3 forward;
uniform vec3 right;
uniform vec3 up;
uniform vec2 depth_map;
uniform int size;

float window_depth(float s) {
    return depth_map.x + depth_map.y / s;
}
