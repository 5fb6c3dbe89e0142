// The rays of all pixels, those that no proxy and no triangle covers included; nothing is drawn.
void main() {
    Ray world = pixel_ray();
    report_ray(world.origin, world.direction);
    discard;
}
