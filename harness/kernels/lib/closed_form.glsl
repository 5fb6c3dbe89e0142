// Real roots of monic polynomials to degree 4 in closed form; NO_ROOT stands where there is none.
// Square roots are the only radicals: float64 GLSL has neither cube roots nor cosines. What would need them, one root of
// a cubic, is Newton's iteration from a bound of that root, as in W. Kahan, To Solve a Real Cubic Equation, 1986 (QBC).
// The quartic is Descartes' product of two quadratics, each coefficient by the formula that does not cancel, after
// A. Orellana and C. De Michele, Algorithm 1010, ACM TOMS 46 (2020).
STRUCT(Roots) struct Roots { real a; real b; real c; real d; };

#define NO_ROOT (-REAL_INFINITY)
#define CUBIC_STEPS 16

Roots no_roots() {
    Roots roots;
    roots.a = NO_ROOT;
    roots.b = NO_ROOT;
    roots.c = NO_ROOT;
    roots.d = NO_ROOT;
    return roots;
}

// Of x^2 + 2 b x + c, in a and b.
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

// About the cube root of x >= 0: 1/4 + 1/16 + 1/64 + ... = 1/3, then one step of Halley's.
real cube_root_estimate(real x) {
    real fourth = sqrt(sqrt(x));
    real sixteenth = sqrt(sqrt(fourth));
    real y = fourth * sixteenth * sqrt(sqrt(sixteenth));
    real cube = y * y * y;
    return x == 0.0 ? real(0) : y * ((cube + 2.0 * x) / (2.0 * cube + x));
}

// The largest real root of x^3 + b x^2 + c x + d (side 1), or the least (side -1); one that exists where the cubic's
// value at its inflection has the other sign than `side`, or where all roots are real.
real outer_cubic_root(real b, real c, real d, real side) {
    real x = -b / 3.0;
    real slope = (x + b) * x + c;
    real value = slope * x + d;
    real reach = cube_root_estimate(fabs(value));
    slope = slope + (2.0 * x + b) * x;
    if (slope < 0.0) reach = 1.328125 * max(reach, sqrt(-slope));
    x += side * reach;
    for (int i = 0; i < CUBIC_STEPS; i++) {
        real q1 = x + b;
        real q0 = q1 * x + c;
        real f = q0 * x + d;
        real derivative = (q1 + x) * x + q0;
        real next = derivative == 0.0 ? x : x - f / derivative;
        if (!(side * next < side * x)) return x;
        x = next;
    }
    return x;
}

Roots cubic_roots(real b, real c, real d) {
    real middle = -b / 3.0;
    real value = ((middle + b) * middle + c) * middle + d;
    real x = outer_cubic_root(b, c, d, value < 0.0 ? 1.0 : -1.0);
    // deflated from the end that loses less (Kahan)
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

// Of x^4 + p x^2 + q x + r = (x^2 + a x + m - h) (x^2 - a x + m + h).
Roots depressed_quartic_roots(real p, real q, real r) {
    // a^2 is any root >= 0 of the resolvent, and there is one; see which outer root is known to be
    real middle = -2.0 * p / 3.0;
    real c = p * p - 4.0 * r;
    real value = ((middle + 2.0 * p) * middle + c) * middle - q * q;
    real square = max(outer_cubic_root(2.0 * p, c, -q * q, value < 0.0 || middle < 0.0 ? 1.0 : -1.0), real(0));
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
