// A ray as a method sees it: its origin moved by `shift`, and the span of its own t that it spends in the domain.
STRUCT(OwnRay) struct OwnRay { Ray ray; real shift; Span span; };

OwnRay make_own_ray(Ray ray, real shift, Span span) {
    OwnRay own;
    own.ray = ray;
    own.shift = shift;
    own.span = span;
    return own;
}
