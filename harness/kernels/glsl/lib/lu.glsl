// Lower bounds of a polynomial on [0, 1] from its Bernstein coefficients b (szente, section 3). With m the least of
// them,
//
//     l(x) = m + (b[0] - m) (1 - x)^n + (b[n] - m) x^n
//
// is nowhere above the polynomial (Equation 5), and its least value is at a point in closed form (Equation 8). Upper
// bounds are the negatives of the lower bounds of -b.
STRUCT(LowerCurve) struct LowerCurve { real least; real first; real last; real lowest_at; };  // m, b[0] - m, b[n] - m

// Returns a^(1/k) for a in [0, 1]: square roots come near it, then Halley's iteration cubes the error with each step.
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

// Returns the curve l. Equation 8 needs both ends above m; if one is equal to m, the curve is least there.
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

// Returns the bound by the control points alone (Equation 2): a curve that is m everywhere.
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

// Returns a bound of the rounding errors of curve_value, which `lower_bound` subtracts.
real curve_error(LowerCurve curve, int degree) {
    return real(2 * degree + 16) * UNIT_ROUNDOFF * (fabs(curve.least) + curve.first + curve.last);
}

// Returns the curve's least value, lowered by more than its rounding errors.
real lower_bound(LowerCurve curve, int degree) {
    return curve_value(curve, curve.lowest_at, degree) - curve_error(curve, degree);
}
