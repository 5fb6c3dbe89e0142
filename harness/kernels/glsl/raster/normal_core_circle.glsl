// Returns the torus's normal at a point p on it: the vector from the nearest point of the core circle to p, divided
// by r (toledo2007, equation 6, with that point written out).
vec3 core_circle_normal(vec3 p) {
    real from_axis = sqrt(p.x * p.x + p.y * p.y);
    real inverse = 1.0 / TUBE_RADIUS;
    real k = (1.0 - RING_RADIUS / from_axis) * inverse;
    return vec3(k * p.x, k * p.y, inverse * p.z);
}
