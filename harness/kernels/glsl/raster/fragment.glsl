// What the vertices pass on to the fragments of an instance.
flat in int instance;
flat in vec3 instance_eye;
flat in vec3 instance_row_x;
flat in vec3 instance_row_y;
flat in vec3 instance_row_z;
flat in vec4 instance_colour_scale;

// Returns the ray through a pixel's middle in the coordinates of the fragment's instance.
Ray local_ray(Ray world) {
    vec3 d = world.direction;
    return make_ray(instance_eye, vec3(inner_product(instance_row_x, d), inner_product(instance_row_y, d),
                                       inner_product(instance_row_z, d)));
}

// Returns the depth buffer's value at t along the ray, t in local lengths. It is never in front of the proxy, which
// `depth_greater` promises to the driver.
float hit_depth(Ray world, real t) {
    return max(window_depth(t * instance_colour_scale.w * inner_product(world.direction, forward)), gl_FragCoord.z);
}
