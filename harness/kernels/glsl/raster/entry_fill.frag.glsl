// Reports the rays of all pixels, also of those that no proxy and no triangle covers. Draws nothing.
void main() {
    Ray world = pixel_ray();
    report_ray(world.origin, world.direction);
    discard;
}
