// A ray p(t) = origin + t direction, and a span [lo, hi] of t, which is empty if lo > hi.
STRUCT(Ray) struct Ray { vec3 origin; vec3 direction; };
STRUCT(Span) struct Span { real lo; real hi; };

Ray make_ray(vec3 origin, vec3 direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return ray;
}

Span make_span(real lo, real hi) {
    Span span;
    span.lo = lo;
    span.hi = hi;
    return span;
}

// Vectors are added and multiplied by components, here and in kernels: with `dot` and the operators on vec3, Intel's
// compiler does not give each lane a ray of its own, and a program takes twice the time.
real inner_product(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

vec3 difference(vec3 a, vec3 b) {
    return vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

// Returns p + t d.
vec3 moved(vec3 p, real t, vec3 d) {
    return vec3(p.x + t * d.x, p.y + t * d.y, p.z + t * d.z);
}

vec3 ray_point(Ray ray, real t) {
    return moved(ray.origin, t, ray.direction);
}

// A variable x in place of t, with t = middle + reach x.
STRUCT(Stretch) struct Stretch { real middle; real reach; };

Stretch make_stretch(real middle, real reach) {
    Stretch stretch;
    stretch.middle = middle;
    stretch.reach = reach;
    return stretch;
}

// Returns v divided by its length; the zero vector if v is zero or not finite.
vec3 unit_vector(vec3 v) {
    PRECISE real size = fabs(v.x) + fabs(v.y) + fabs(v.z);
    if (!(size > 0.0 && size < REAL_INFINITY)) return vec3(0.0, 0.0, 0.0);
    vec3 w = v / size;
    return w / sqrt(dot(w, w));
}

// Returns o + t d with about one rounding.
real advanced(real o, real t, real d) {
    Pair product = two_prod(t, d);
    Pair sum = two_sum(o, product.hi);
    PRECISE real low = sum.lo + product.lo;
    PRECISE real result = sum.hi + low;
    return result;
}

// Returns the same ray with its origin moved by t, so that methods work with small parameters however far the camera
// is.
Ray advanced_ray(Ray ray, real t) {
    return make_ray(vec3(advanced(ray.origin.x, t, ray.direction.x),
                         advanced(ray.origin.y, t, ray.direction.y),
                         advanced(ray.origin.z, t, ray.direction.z)), ray.direction);
}
