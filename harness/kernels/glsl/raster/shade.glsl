// Shades by a headlight: by the cosine between ray and normal, the same for both sides of a surface.
vec4 lit(vec3 colour, vec3 normal, vec3 direction) {
    return vec4(colour * (0.25 + 0.75 * fabs(inner_product(normal, direction))), 1.0);
}
