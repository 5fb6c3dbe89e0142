// A beam: every ray of a rectangle of the image. Its points are eye + s (forward + x right + y up), x and y in
// intervals, for depths s in [near, far], which span the domain. It is closed, and wider by BEAM_SLACK than the
// rectangle: float32 rays through it, made here or on the host, are in it, rounding included.
STRUCT(Camera) struct Camera {
    vec3 forward; vec3 right; vec3 up;           // as the host gives them
    vec3 eye_lower; vec3 eye_upper;              // widened by what rounding does to a point of a beam
    vec3 forward_lower; vec3 forward_upper;      // widened by BEAM_SLACK
    real near; real far;
};
STRUCT(Beam) struct Beam { vec3 eye_lower; vec3 eye_upper; vec3 lower; vec3 upper; real near; real far; };
STRUCT(Box) struct Box { vec3 lower; vec3 upper; };

#define BEAM_SLACK 9.5367431640625e-7  // 2^-20 of each coordinate's terms: sixteen roundings in float32

vec3 absolute(vec3 a) {
    return vec3(fabs(a.x), fabs(a.y), fabs(a.z));
}

vec3 least(vec3 a, vec3 b) {
    return vec3(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z));
}

vec3 greatest(vec3 a, vec3 b) {
    return vec3(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z));
}

// The camera with the depths that the domain spans, a little more than they are.
Camera make_camera(vec3 eye, vec3 forward, vec3 right, vec3 up) {
    vec3 half_size = (DOMAIN_UPPER - DOMAIN_LOWER) * 0.5;
    real reach = DOMAIN_IS_BOX == 1 ? dot(absolute(forward), half_size) : DOMAIN_RADIUS;
    real middle = dot(DOMAIN_CENTER - eye, forward);
    reach = reach + 1.52587890625e-5 * (DOMAIN_RADIUS + fabs(middle));
    Camera camera;
    camera.forward = forward;
    camera.right = right;
    camera.up = up;
    camera.near = max(middle - reach, real(0));
    camera.far = max(middle + reach, real(0));
    vec3 longest = absolute(forward) + absolute(right) + absolute(up);
    camera.forward_lower = forward - longest * BEAM_SLACK;
    camera.forward_upper = forward + longest * BEAM_SLACK;
    vec3 rounding = (absolute(eye) + longest * camera.far) * (8.0 * UNIT_ROUNDOFF);
    camera.eye_lower = eye - rounding;
    camera.eye_upper = eye + rounding;
    return camera;
}

// The beam of the pixels from column i0 up to i1 and row j0 up to j1 of a size by size image, row 0 at the top.
Beam camera_beam(Camera camera, int i0, int j0, int i1, int j1, int size) {
    real step = 2.0 / real(size);
    vec3 x0 = camera.right * (real(i0) * step - 1.0);
    vec3 x1 = camera.right * (real(i1) * step - 1.0);
    vec3 y0 = camera.up * (1.0 - real(j1) * step);
    vec3 y1 = camera.up * (1.0 - real(j0) * step);
    Beam beam;
    beam.lower = camera.forward_lower + least(x0, x1) + least(y0, y1);
    beam.upper = camera.forward_upper + greatest(x0, x1) + greatest(y0, y1);
    beam.eye_lower = camera.eye_lower;
    beam.eye_upper = camera.eye_upper;
    beam.near = camera.near;
    beam.far = camera.far;
    return beam;
}

// The box that holds the beam's points of depths [s0, s1], s0 >= 0, in the domain; lower > upper where there are none.
Box beam_box(Beam beam, real s0, real s1) {
    Box box;
    box.lower = greatest(beam.eye_lower + least(beam.lower * s0, beam.lower * s1), DOMAIN_LOWER);
    box.upper = least(beam.eye_upper + greatest(beam.upper * s0, beam.upper * s1), DOMAIN_UPPER);
    return box;
}

// Whether no point of the box is in the domain.
bool outside_domain(Box box) {
    if (box.lower.x > box.upper.x || box.lower.y > box.upper.y || box.lower.z > box.upper.z) return true;
    vec3 center = DOMAIN_CENTER;
    vec3 gap = greatest(greatest(box.lower - center, center - box.upper), vec3(0.0, 0.0, 0.0));
    return DOMAIN_IS_BOX == 0 && dot(gap, gap) > DOMAIN_RADIUS * DOMAIN_RADIUS * (1.0 + 16.0 * UNIT_ROUNDOFF);
}

// f's range over the box.
Interval box_range(Box box) {
    return surface_range(make_interval(box.lower.x, box.upper.x), make_interval(box.lower.y, box.upper.y),
                         make_interval(box.lower.z, box.upper.z));
}

// The depth at which piece `path` of the tree of halves begins: 1 is [near, far], 2 p and 2 p + 1 are the halves of
// p, each `width` deep. Products by powers of two are exact, so that neighbours share their ends bit for bit.
real path_depth(Beam beam, int path, real width) {
    return beam.near + (real(path) * width - (beam.far - beam.near));
}
