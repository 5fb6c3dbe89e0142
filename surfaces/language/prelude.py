"""Hold the functions that are defined in the language itself, by the operations of the tape.

A name that begins with _ is for this page alone. A function that is defined for different numbers of values stands here
once for each.
"""

from __future__ import annotations

from functools import cache

from surfaces.language.names import Function, Names
from surfaces.language.statements import Parser

TEXT = """
square(a) = a^2;  sqr(a) = a^2;  cube(a) = a^3;
ln(a) = log(a);  log2(a) = log(a)/log(2);  log10(a) = log(a)/log(10);  exp2(a) = 2^a;
cbrt(a) = max(a, 0)^(1/3) - max(-a, 0)^(1/3);   # continuous, unlike sign(a)*abs(a)^(1/3)

sec(a) = 1/cos(a);  csc(a) = 1/sin(a);  cot(a) = cos(a)/sin(a);
asin(a) = atan2(a, sqrt((1 - a)*(1 + a)));
acos(a) = atan2(sqrt((1 - a)*(1 + a)), a);
atan(a) = atan2(a, 1);  atan(b, a) = atan2(b, a);
arcsin(a) = asin(a);  arccos(a) = acos(a);  arctan(a) = atan(a);  arctan2(b, a) = atan2(b, a);

sinh(a) = (exp(a) - exp(-a))/2;  cosh(a) = (exp(a) + exp(-a))/2;
tanh(a) = 1 - 2/(exp(2*a) + 1);   # no quotient of two infinities
sech(a) = 1/cosh(a);  csch(a) = 1/sinh(a);  coth(a) = 1/tanh(a);
asinh(a) = log(a + sqrt(a^2 + 1));
acosh(a) = log(a + sqrt((a - 1)*(a + 1)));
atanh(a) = log((1 + a)/(1 - a))/2;
arcsinh(a) = asinh(a);  arccosh(a) = acosh(a);  arctanh(a) = atanh(a);
radians(a) = a*pi/180;  degrees(a) = a*180/pi;

sign(a) = (a >= 0) - (a <= 0);  sgn(a) = sign(a);   # 0 at 0
fabs(a) = abs(a);  fmin(a, b) = min(a, b);  fmax(a, b) = max(a, b);
ceil(a) = -floor(-a);
round(a) = floor(a + 1/2);
trunc(a) = if(a >= 0, floor(a), ceil(a));
fract(a) = a - floor(a);  frac(a) = fract(a);
mod(a, b) = a - b*floor(a/b);  fmod(a, b) = a - b*trunc(a/b);   # with the sign of b, and of a
clamp(a, lower, upper) = min(max(a, lower), upper);
saturate(a) = clamp(a, 0, 1);
mix(a, b, t) = a + (b - a)*t;  lerp(a, b, t) = mix(a, b, t);
step(edge, a) = a >= edge;
_hermite(t) = t^2*(3 - 2*t);
smoothstep(lower, upper, a) = _hermite(clamp((a - lower)/(upper - lower), 0, 1));
hypot(a, b) = length(a, b);  hypot(a, b, c) = length(a, b, c);
norm(a, b) = length(a, b);  norm(a, b, c) = length(a, b, c);
dot(a, b, c, p, q, r) = a*p + b*q + c*r;  dot(a, b, p, q) = a*p + b*q;
"""


@cache
def library() -> dict[str, dict[int, Function]]:
    """Return the functions by name and number of values. They are parsed once."""
    names = Names(frozenset(), {})
    parser = Parser(TEXT, names, own=False)
    parser.definitions(len(parser.tokens) - 1)
    return names.library
