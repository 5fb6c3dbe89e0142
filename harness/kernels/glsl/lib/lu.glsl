// A polynomial's lower bound on [0, 1] from its Bernstein coefficients b (szente, section 3): with m the least of them,
//
//     l(x) = m + (b[0] - m) (1 - x)^n + (b[n] - m) x^n
//
// is nowhere above it (Equation 5), and least at a point in closed form (Equation 8). Upper bounds are those of -b.
STRUCT(LowerCurve) struct LowerCurve { real least; real first; real last; real lowest_at; };  // m, b[0] - m, b[n] - m

// a^(1/k) for a in [0, 1]: square roots into its neighbourhood, then Halley's iteration, which cubes the error.
real kth_root(real a, int k) {
    real y = a;
    for (int power = 1; 10 * power < 7 * k; power = 2 * power) y = sqrt(y);
    real step = y;
    for (int i = 0; i < 8 && step > 0.000244140625 * y; i++) {
        real z = whole_power(y, k);
        real next = y * ((real(k - 1) * z + real(k + 1) * a) / (real(k + 1) * z + real(k - 1) * a));
        step = fabs(next - y);
        y = next;
    }
    return y;
}

// Equation 8 needs both ends above m; where one is not, the curve is least at that end, and equal to m.
LowerCurve lu_curve(IN real b[COEFFICIENTS], int degree) {
    LowerCurve curve;
    curve.least = b[0];
    for (int j = 1; j <= degree; j++) curve.least = min(curve.least, b[j]);
    curve.first = b[0] - curve.least;
    curve.last = b[degree] - curve.least;
    curve.lowest_at = curve.first > 0.0 ? real(1) : real(0);
    if (curve.first > 0.0 && curve.last > 0.0) {
        real root = kth_root(min(curve.first, curve.last) / max(curve.first, curve.last), degree - 1);
        curve.lowest_at = (curve.first < curve.last ? root : real(1)) / (1.0 + root);
    }
    return curve;
}

// The control points' own bound (Equation 2): a curve that is m everywhere.
LowerCurve control_point_curve(IN real b[COEFFICIENTS], int degree) {
    LowerCurve curve;
    curve.least = b[0];
    for (int j = 1; j <= degree; j++) curve.least = min(curve.least, b[j]);
    curve.first = 0.0;
    curve.last = 0.0;
    curve.lowest_at = 0.0;
    return curve;
}

real curve_value(LowerCurve curve, real x, int degree) {
    return curve.least + (curve.first * whole_power(1.0 - x, degree) + curve.last * whole_power(x, degree));
}

// What lowers a value of the curve by more than its rounding errors.
real curve_error(LowerCurve curve, int degree) {
    return real(2 * degree + 16) * UNIT_ROUNDOFF * (fabs(curve.least) + curve.first + curve.last);
}

// The curve's least value, lowered by more than its rounding errors.
real lower_bound(LowerCurve curve, int degree) {
    return curve_value(curve, curve.lowest_at, degree) - curve_error(curve, degree);
}
