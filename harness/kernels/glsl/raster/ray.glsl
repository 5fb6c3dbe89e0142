// Returns the ray through the middle of the fragment's pixel, in world coordinates.
Ray pixel_ray() {
    return camera_ray(eye, forward, right, up, int(gl_FragCoord.x), size - 1 - int(gl_FragCoord.y), size, size);
}
