// A beam: every ray of a rectangle of the image. Its points are eye + s (forward + x right + y up), x and y in
// intervals, for depths s in [near, far], which span the domain. It is closed, and wider by BEAM_SLACK than the
// rectangle: float32 rays through it, made here or on the host, are in it, rounding included.
STRUCT(Camera) struct Camera { vec3 eye; vec3 forward; vec3 right; vec3 up; };
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

// The depths that the domain spans, a little more than they are.
Span domain_depths(Camera camera) {
    vec3 half_size = (DOMAIN_UPPER - DOMAIN_LOWER) * 0.5;
    real reach = DOMAIN_IS_BOX == 1 ? dot(absolute(camera.forward), half_size) : DOMAIN_RADIUS;
    real middle = dot(DOMAIN_CENTER - camera.eye, camera.forward);
    reach = reach + 1.52587890625e-5 * (DOMAIN_RADIUS + fabs(middle));
    return make_span(max(middle - reach, real(0)), max(middle + reach, real(0)));
}

// The beam of the rectangle from pixel (i0, j0) to (i1, j1), their far sides, of an nx by ny image, row 0 at the top.
Beam camera_beam(Camera camera, int i0, int j0, int i1, int j1, int nx, int ny) {
    vec3 x0 = camera.right * (real(2 * i0 - nx) / real(nx));
    vec3 x1 = camera.right * (real(2 * i1 - nx) / real(nx));
    vec3 y0 = camera.up * (real(ny - 2 * j1) / real(ny));
    vec3 y1 = camera.up * (real(ny - 2 * j0) / real(ny));
    vec3 slack = (absolute(camera.forward) + absolute(camera.right) + absolute(camera.up)) * BEAM_SLACK;
    Span depths = domain_depths(camera);
    Beam beam;
    beam.lower = camera.forward + least(x0, x1) + least(y0, y1) - slack;
    beam.upper = camera.forward + greatest(x0, x1) + greatest(y0, y1) + slack;
    vec3 rounding = (absolute(camera.eye) + greatest(absolute(beam.lower), absolute(beam.upper)) * depths.hi)
                    * (8.0 * UNIT_ROUNDOFF);
    beam.eye_lower = camera.eye - rounding;
    beam.eye_upper = camera.eye + rounding;
    beam.near = depths.lo;
    beam.far = depths.hi;
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
