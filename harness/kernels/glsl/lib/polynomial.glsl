// Polynomials and their real roots, after Yuksel 2022, High-performance polynomial root finding. The basis is
// monomial, with the sum of q[j] x^j, or Bernstein, with the sum of q[j] x^j (1 - x)^(degree - j), where q[j]
// includes the binomial.
#define COEFFICIENTS 21  // the size of every array, for degrees to 20: the surface's degree is not known here
#define MOST_STEPS 64    // of one bracketed Newton iteration; halving alone would need fewer
#define THIRD 0.3333333432674407958984375

Dual polynomial_dual(IN real q[COEFFICIENTS], int degree, bool bernstein, real x) {
    real value = q[degree];
    real slope = 0.0;
    if (bernstein) {
        real y = 1.0 - x;
        real power = 1.0;
        real power_slope = 0.0;
        for (int j = degree - 1; j >= 0; j--) {
            power_slope = power_slope * y - power;
            power = power * y;
            slope = slope * x + value + q[j] * power_slope;
            value = value * x + q[j] * power;
        }
    } else {
        for (int j = degree - 1; j >= 0; j--) {
            slope = slope * x + value;
            value = value * x + q[j];
        }
    }
    return make_dual(value, slope);
}

// Returns the root of a linear q, moved to the nearer end of [lo, hi] if it is outside; hi if q has none.
real linear_root(IN real q[COEFFICIENTS], bool bernstein, real lo, real hi) {
    real slope = bernstein ? q[1] - q[0] : q[1];
    return slope == 0.0 ? hi : clamp(-q[0] / slope, lo, hi);
}

// Sets x[1] and x[2] to the roots of a quadratic q in ascending order. A root outside [x[0], x[3]] is moved to the
// nearer end; if there is none, both are x[3]. The formula's form is the one that does not cancel.
void quadratic_roots(INOUT real x[COEFFICIENTS], IN real q[COEFFICIENTS], bool bernstein) {
    real a = bernstein ? q[0] - q[1] + q[2] : q[2];
    real b = bernstein ? q[1] - 2.0 * q[0] : q[1];
    real discriminant = b * b - 4.0 * a * q[0];
    real root = sqrt(max(discriminant, real(0)));
    real sum = b < 0.0 ? b - root : b + root;
    bool any = discriminant >= 0.0;
    real first = clamp(any && sum != 0.0 ? -2.0 * q[0] / sum : x[3], x[0], x[3]);
    real second = clamp(any && a != 0.0 ? -0.5 * sum / a : x[3], x[0], x[3]);
    x[1] = min(first, second);
    x[2] = max(first, second);
}

// An interval [a, b] in which the function changes its sign, the x to look at next, and its distance from the last x.
STRUCT(Bracket) struct Bracket { real a; real b; real x; real step; };

Bracket bracket_from(real a, real b, real way) {
    Bracket bracket;
    bracket.a = a;
    bracket.b = b;
    bracket.x = a + (b - a) * way;
    bracket.step = b - a;
    return bracket;
}

// Returns the bracket [a, b]; `from` and `to` are the function's values at its ends. Its first x is the result of one
// Newton step from the middle on the cubic that has these values, and slope 0 at both ends, as q has between two
// critical points.
Bracket make_bracket(real a, real b, real from, real to) {
    return bracket_from(a, b, 0.5 + THIRD * ((from + to) / (from - to)));
}

// Returns the same for piece k of `degree` pieces. The first and the last piece have a critical point at one end
// only, so that to degree 4 their first x is the root of the parabola with slope 0 there. Beyond degree 4 a parabola
// is no better than the cubic.
Bracket make_end_bracket(real a, real b, real from, real to, int k, int degree) {
    real share = from / (from - to);
    if (degree <= 4 && k == 1) return bracket_from(a, b, 1.0 - sqrt(1.0 - share));
    if (degree <= 4 && k == degree) return bracket_from(a, b, sqrt(share));
    return make_bracket(a, b, from, to);
}

// Takes a Newton step from bracket.x, where the function's value and derivative are f. A step that would leave the
// bracket is replaced by halving it.
Bracket newton_step(Bracket bracket, Dual f, bool rising) {
    Bracket next = bracket;
    if ((f.value < 0.0) == rising) { next.a = bracket.x; } else { next.b = bracket.x; }
    next.x = bracket.x - f.value / f.derivative;
    if (!(next.x >= next.a && next.x <= next.b)) next.x = 0.5 * (next.a + next.b);
    next.step = fabs(next.x - bracket.x);
    return next;
}

// Takes one level of Yuksel's method. On entry x[0] to x[degree] are the ends of pieces on which q is monotone. On
// return x[1] to x[degree] are the pieces' roots, or a piece's far end if it has none, and x[degree + 1] is the last
// end: these are the ends of pieces on which an antiderivative of q is monotone. Newton's method starts from the
// cubic of make_bracket, or with `middle` from a piece's middle.
void split_at_roots(INOUT real x[COEFFICIENTS], IN real q[COEFFICIENTS], int degree, bool bernstein, real tolerance,
                    bool middle) {
    real a = x[0];
    real from = polynomial_dual(q, degree, bernstein, a).value;
    x[degree + 1] = x[degree];
    for (int k = 1; k <= degree; k++) {
        real b = x[k];
        real to = polynomial_dual(q, degree, bernstein, b).value;
        if ((from < 0.0) != (to < 0.0)) {
            Bracket bracket = middle ? bracket_from(a, b, 0.5) : make_bracket(a, b, from, to);
            for (int i = 0; i < MOST_STEPS && bracket.step > tolerance; i++) {
                bracket = newton_step(bracket, polynomial_dual(q, degree, bernstein, bracket.x), from < 0.0);
            }
            x[k] = bracket.x;
        }
        a = b;
        from = to;
    }
}
