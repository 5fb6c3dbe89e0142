// A beam holds every ray through a rectangle of the image. Its points are eye + s (forward + x right + y up), where x
// and y lie in the rectangle's intervals and the depth s in [near, far], which spans the domain. The beam is closed and
// BEAM_SLACK wider than the rectangle, so that it holds all float32 rays through the rectangle, made here or on the
// host, with their rounding errors.
STRUCT(Camera) struct Camera {
    vec3 forward; vec3 right; vec3 up;    // as the host gives them
    Interval ex; Interval ey; Interval ez;  // the eye, widened by the rounding errors of a beam's points
    Interval fx; Interval fy; Interval fz;  // forward, widened by BEAM_SLACK of each coordinate's terms
    real near; real far;
};
STRUCT(Beam) struct Beam {
    Interval ex; Interval ey; Interval ez;
    Interval dx; Interval dy; Interval dz;  // the direction: a point is e + s d
    real near; real far;
};
STRUCT(Box) struct Box { Interval x; Interval y; Interval z; };

#define BEAM_SLACK 9.5367431640625e-7  // 2^-20 of each coordinate's terms, which is sixteen float32 roundings

Interval widened(real a, real slack) {
    return make_interval(a - slack, a + slack);
}

// Makes a camera whose depths [near, far] span slightly more than the domain.
Camera make_camera(vec3 eye, vec3 forward, vec3 right, vec3 up) {
    vec3 size = difference(DOMAIN_UPPER, DOMAIN_LOWER);
    real across = fabs(forward.x) * size.x + fabs(forward.y) * size.y + fabs(forward.z) * size.z;
    real reach = DOMAIN_IS_BOX == 1 ? 0.5 * across : DOMAIN_RADIUS;
    real middle = inner_product(difference(DOMAIN_CENTER, eye), forward);
    reach = reach + 1.52587890625e-5 * (DOMAIN_RADIUS + fabs(middle));
    Camera camera;
    camera.forward = forward;
    camera.right = right;
    camera.up = up;
    camera.near = max(middle - reach, real(0));
    camera.far = max(middle + reach, real(0));
    real x = fabs(forward.x) + fabs(right.x) + fabs(up.x);
    real y = fabs(forward.y) + fabs(right.y) + fabs(up.y);
    real z = fabs(forward.z) + fabs(right.z) + fabs(up.z);
    camera.fx = widened(forward.x, x * BEAM_SLACK);
    camera.fy = widened(forward.y, y * BEAM_SLACK);
    camera.fz = widened(forward.z, z * BEAM_SLACK);
    camera.ex = widened(eye.x, 8.0 * UNIT_ROUNDOFF * (fabs(eye.x) + x * camera.far));
    camera.ey = widened(eye.y, 8.0 * UNIT_ROUNDOFF * (fabs(eye.y) + y * camera.far));
    camera.ez = widened(eye.z, 8.0 * UNIT_ROUNDOFF * (fabs(eye.z) + z * camera.far));
    return camera;
}

// Returns f + [x0, x1] r + [y0, y1] u, which is one coordinate of a beam's direction.
Interval beam_direction(Interval f, real r, real u, real x0, real x1, real y0, real y1) {
    return make_interval(f.lo + min(x0 * r, x1 * r) + min(y0 * u, y1 * u),
                         f.hi + max(x0 * r, x1 * r) + max(y0 * u, y1 * u));
}

// Returns the beam of columns i0 to i1 - 1 and rows j0 to j1 - 1 of an image of size by size pixels; row 0 is the top.
Beam camera_beam(Camera camera, int i0, int j0, int i1, int j1, int size) {
    real step = 2.0 / real(size);
    real x0 = real(i0) * step - 1.0;
    real x1 = real(i1) * step - 1.0;
    real y0 = 1.0 - real(j1) * step;
    real y1 = 1.0 - real(j0) * step;
    Beam beam;
    beam.ex = camera.ex;
    beam.ey = camera.ey;
    beam.ez = camera.ez;
    beam.dx = beam_direction(camera.fx, camera.right.x, camera.up.x, x0, x1, y0, y1);
    beam.dy = beam_direction(camera.fy, camera.right.y, camera.up.y, x0, x1, y0, y1);
    beam.dz = beam_direction(camera.fz, camera.right.z, camera.up.z, x0, x1, y0, y1);
    beam.near = camera.near;
    beam.far = camera.far;
    return beam;
}

// Returns the part of e + [s0, s1] d in [lower, upper]; e is already widened by the rounding errors made here.
Interval beam_coordinate(Interval e, Interval d, real s0, real s1, real lower, real upper) {
    return make_interval(max(e.lo + min(d.lo * s0, d.lo * s1), lower), min(e.hi + max(d.hi * s0, d.hi * s1), upper));
}

// Returns a box that holds the beam's points of depths [s0, s1], s0 >= 0, in the domain; lo > hi on an axis if there
// are none.
Box beam_box(Beam beam, real s0, real s1) {
    vec3 lower = DOMAIN_LOWER;
    vec3 upper = DOMAIN_UPPER;
    Box box;
    box.x = beam_coordinate(beam.ex, beam.dx, s0, s1, lower.x, upper.x);
    box.y = beam_coordinate(beam.ey, beam.dy, s0, s1, lower.y, upper.y);
    box.z = beam_coordinate(beam.ez, beam.dz, s0, s1, lower.z, upper.z);
    return box;
}

// Returns the distance of a coordinate from an interval, 0 inside it.
real gap(Interval a, real c) {
    return max(max(a.lo - c, c - a.hi), real(0));
}

// Returns whether no point of the box is in the domain.
bool outside_domain(Box box) {
    if (box.x.lo > box.x.hi || box.y.lo > box.y.hi || box.z.lo > box.z.hi) return true;
    vec3 center = DOMAIN_CENTER;
    real x = gap(box.x, center.x);
    real y = gap(box.y, center.y);
    real z = gap(box.z, center.z);
    return DOMAIN_IS_BOX == 0
           && x * x + y * y + z * z > DOMAIN_RADIUS * DOMAIN_RADIUS * (1.0 + 16.0 * UNIT_ROUNDOFF);
}

// Returns an interval that holds f's values over the box.
Interval box_range(Box box) {
    return surface_range(box.x, box.y, box.z);
}

// Returns the depth at which piece `path` of the binary tree of depths begins, whose pieces are `width` deep on its
// level. Piece 1 is [near, far]; pieces 2 p and 2 p + 1 are the halves of piece p. Products by powers of two are
// exact, so that neighbouring pieces share their ends bit for bit.
real path_depth(Beam beam, int path, real width) {
    return beam.near + (real(path) * width - (beam.far - beam.near));
}
