// What a fragment of an instance casts: the ray through its pixel's middle, in the instance's own coordinates.
flat in int instance;
flat in vec3 instance_eye;
flat in vec3 instance_row_x;
flat in vec3 instance_row_y;
flat in vec3 instance_row_z;
flat in vec4 instance_colour_scale;

Ray local_ray(Ray world) {
    vec3 d = world.direction;
    return make_ray(instance_eye, vec3(inner_product(instance_row_x, d), inner_product(instance_row_y, d),
                                       inner_product(instance_row_z, d)));
}

// The depth buffer's value at t along the ray, in local lengths; never in front of the proxy, as is promised.
float hit_depth(Ray world, real t) {
    return max(window_depth(t * instance_colour_scale.w * inner_product(world.direction, forward)), gl_FragCoord.z);
}
