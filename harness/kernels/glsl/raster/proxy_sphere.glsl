// Returns corner k of a polygon of PROXY_SIDES sides that covers the ball as seen from the eye. The polygon lies in the
// plane that touches the ball at its point nearest to the eye.
vec3 proxy_corner(int k, vec3 lower, vec3 upper, float radius, vec3 local_eye) {
    vec3 center = 0.5 * (lower + upper);
    vec3 to_eye = local_eye - center;
    float away = length(to_eye);
    vec3 axis = to_eye / away;
    float tangent = radius / sqrt(away * away - radius * radius);
    float circle = (away - radius) * tangent / cos(3.14159265358979 / float(PROXY_SIDES));
    vec3 side = normalize(fabs(axis.z) < 0.75 ? vec3(axis.y, -axis.x, 0.0) : vec3(0.0, axis.z, -axis.y));
    vec3 other = cross(axis, side);
    float turn = 6.28318530717959 * float(k) / float(PROXY_SIDES);
    return center + radius * axis + circle * (cos(turn) * side + sin(turn) * other);
}
