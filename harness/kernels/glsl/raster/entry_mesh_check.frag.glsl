// As entry_mesh, and reports where the ray through the pixel's middle meets the triangle.
flat in int instance;
flat in vec3 instance_colour;
in vec3 offset;
in vec3 normal;
layout(location = 0) out vec4 picture;
void main() {
    Ray world = pixel_ray();
    report_fragment(world, 0, HIT);
    picture = lit(instance_colour, mesh_normal(normal), unit_vector(offset));
    report_seen(world, 0.0, inner_product(offset, world.direction), instance, true);
}
