// Real roots of monic polynomials of degree 2 to 4 in closed form; NO_ROOT stands for a root that does not exist.
//
// Cubics: one root is computed by Cardano's formula, or by Viète's if three are real. The cubic is then divided by
// it, as in W. Kahan, To Solve a Real Cubic Equation, 1986, and the others are roots of the quotient. The only
// functions called are square roots, since float64 GLSL has neither cube roots nor cosines, and Mesa's arc cosine is
// wrong by 1e-4. cos(acos(c) / 3) is computed as a polynomial in one square root, a cube root by six square roots and
// two of Halley's steps. Both are wrong by less than 1e-5; CORRECTIONS of Newton's steps remove that.
//
// Quartics: they are factored into two quadratics after Descartes. Each coefficient is computed by the formula that
// does not cancel, after A. Orellana and C. De Michele, Algorithm 1010, ACM TOMS 46 (2020).
STRUCT(Roots) struct Roots { real a; real b; real c; real d; };

#define NO_ROOT (-REAL_INFINITY)
#define A_THIRD (real(1) / real(3))
#define CORRECTIONS (UNIT_ROUNDOFF < 2.3283064365386963e-10 ? 2 : 1)  // float64, float32

Roots no_roots() {
    Roots roots;
    roots.a = NO_ROOT;
    roots.b = NO_ROOT;
    roots.c = NO_ROOT;
    roots.d = NO_ROOT;
    return roots;
}

// Returns the roots of x^2 + 2 b x + c as a and b.
Roots quadratic_roots(real b, real c) {
    Roots roots = no_roots();
    Pair square = two_prod(b, b);
    real discriminant = (square.hi - c) + square.lo;
    if (discriminant >= 0.0) {
        real outer = b < 0.0 ? sqrt(discriminant) - b : -sqrt(discriminant) - b;
        roots.a = outer;
        roots.b = outer == 0.0 ? outer : c / outer;
    }
    return roots;
}

real halley_cube_root(real y, real x) {
    real cube = y * y * y;
    return y * ((cube + 2.0 * x) / (2.0 * cube + x));
}

// Returns the cube root of x >= 0 with a relative error under 1e-5 for x from 1e-30 to 1e30. The start is x to the
// power 1/4 + 1/16 + 1/64, near 1/3; two of Halley's steps follow.
real cube_root(real x) {
    real fourth = sqrt(sqrt(x));
    real sixteenth = sqrt(sqrt(fourth));
    real y = fourth * sixteenth * sqrt(sqrt(sixteenth));
    return x == 0.0 ? real(0) : halley_cube_root(halley_cube_root(y, x), x);
}

// Returns cos(acos(c) / 3) for c in [-1, 1] to 1e-7. It equals cos(2/3 acos(w)) with w = sqrt((1 + c) / 2), which has
// no singularity for w in [0, 1].
real third_angle_cosine(real c) {
    real w = sqrt(0.5 + 0.5 * c);
    real tail = -0.03031306341290474 +
                w * (0.01615948975086212 + w * (-0.006169949658215046 + w * 0.0011504290159791708));
    return 0.5 + w * (0.5773472189903259 + w * (-0.11104323714971542 + w * (0.05286910757422447 + w * tail)));
}

// Returns the root of x^3 + b x^2 + c x + d that is farthest from the inflection; with `largest`, the largest root. For
// `largest`, three roots must be real whenever the cubic's value at the inflection is positive.
real cubic_root(real b, real c, real d, bool largest) {
    // with x = middle + y the cubic is y^3 - 3 p y + 2 q, and three roots are real if q^2 <= p^3, tested without powers
    real middle = -A_THIRD * b;
    real p = middle * middle - A_THIRD * c;
    real q = 0.5 * (((middle + b) * middle + c) * middle + d);
    real radius = sqrt(fabs(p));
    real power = fabs(p) * radius;
    real most = max(fabs(q), power);
    real share = most > 0.0 ? min(fabs(q), power) / most : real(0);
    bool turned = largest && q > 0.0;
    real y = 0.0;
    if (turned || (p > 0.0 && fabs(q) <= power)) {
        real cosine = third_angle_cosine(turned ? -(fabs(q) <= power ? share : real(1)) : share);
        y = (q > 0.0 && !turned ? -2.0 : 2.0) * radius * cosine;
    } else if (most > 0.0) {
        real u = cube_root(fabs(q) + most * sqrt(p > 0.0 ? (1.0 - share) * (1.0 + share) : 1.0 + share * share));
        real v = p / u;
        y = -2.0 * q / (u * u - p + v * v);
    }
    real x = middle + y;
    for (int i = 0; i < CORRECTIONS; i++) {
        real q1 = x + b;
        real q0 = q1 * x + c;
        real step = (q0 * x + d) / ((q1 + x) * x + q0);
        if (fabs(step) < 0.015625 * fabs(y)) x -= step;
    }
    return x;
}

Roots cubic_roots(real b, real c, real d) {
    real x = cubic_root(b, c, d, false);
    // the quotient is computed from the end that loses fewer digits (Kahan)
    real q1 = x + b;
    real q0 = q1 * x + c;
    if (fabs(x * x * x) > fabs(d) && x != 0.0) {
        q0 = -d / x;
        q1 = (q0 - c) / x;
    }
    Roots roots = quadratic_roots(0.5 * q1, q0);
    roots.c = x;
    return roots;
}

// Returns the roots of x^4 + p x^2 + q x + r, which is (x^2 + a x + m - h) (x^2 - a x + m + h).
Roots depressed_quartic_roots(real p, real q, real r) {
    // a^2 is any root >= 0 of the resolvent; if p > 0 its inflection is negative, and so may be the farthest root
    real c = p * p - 4.0 * r;
    real square = max(cubic_root(2.0 * p, c, -q * q, p > 0.0), real(0));
    real m = 0.5 * (p + square);
    real h = sqrt(max(m * m - r, real(0)));
    real a = sqrt(square);
    if (h > square) {
        a = 0.5 * fabs(q) / h;
    } else if (a > 0.0) {
        h = 0.5 * fabs(q) / a;
    }
    if (q < 0.0) h = -h;
    real first = m - h;
    real second = m + h;
    if (fabs(first) > fabs(second)) {
        second = r / first;
    } else if (second != 0.0) {
        first = r / second;
    }
    Roots roots = quadratic_roots(0.5 * a, first);
    Roots others = quadratic_roots(-0.5 * a, second);
    roots.c = others.a;
    roots.d = others.b;
    return roots;
}
