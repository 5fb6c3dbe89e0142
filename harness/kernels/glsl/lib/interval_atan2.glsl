// The angles of points of a rectangle. GLSL allows atan an error of 4096 ulp, so it is computed here; in float64 GLSL
// has none.

#define INTERVAL_PI 3.140625  // pi in parts of 12, 12, 12 and 24 bits, as for reduced_sin
#define INTERVAL_PI_REST (real(9.67502593994140625e-4) + (real(1.50990672409534454e-7) + real(5.12668824e-12)))

// Returns atan(t) for t in [0, 1] with a relative error within 45 u. The angle is halved twice, by tan(a / 2) =
// t / (1 + sqrt(1 + t t)), where a division is wrong by 5 u and a root by 9 u as the specifications allow: 5 u of t
// become 14 u and 26 u. The series of 13 terms is cut off below 0.199^26 / 27, less than 3e-20; its sum adds 8 u. It is no loop,
// as for whole_power.
real small_angle(real t) {
    real half_angle = t / (1.0 + sqrt(1.0 + t * t));
    real r = half_angle / (1.0 + sqrt(1.0 + half_angle * half_angle));
    real square = r * r;
    real sum = real(1) / real(25);
    sum = real(1) / real(23) - square * sum;
    sum = real(1) / real(21) - square * sum;
    sum = real(1) / real(19) - square * sum;
    sum = real(1) / real(17) - square * sum;
    sum = real(1) / real(15) - square * sum;
    sum = real(1) / real(13) - square * sum;
    sum = real(1) / real(11) - square * sum;
    sum = real(1) / real(9) - square * sum;
    sum = real(1) / real(7) - square * sum;
    sum = real(1) / real(5) - square * sum;
    sum = real(1) / real(3) - square * sum;
    sum = real(1) / real(1) - square * sum;
    return 4.0 * (r * sum);
}

// Returns the angle of the point (x, y), y >= 0, from 0 to pi, with a relative error within 64 u. The larger of |x| and
// y is a normal number and no larger than INTERVAL_LARGEST_DIVISOR.
real upper_angle(real y, real x) {
    real far = max(fabs(x), y);
    real angle = small_angle(min(fabs(x), y) / far);
    if (y > fabs(x)) angle = 0.5 * INTERVAL_PI + (0.5 * INTERVAL_PI_REST - angle);
    return x < 0.0 ? INTERVAL_PI + (INTERVAL_PI_REST - angle) : angle;
}

// Returns the range of the angle of points (x, y), x in b and y in a >= 0, which are not all at 0. The extremes are at
// corners, as seen from the origin.
Interval upper_angles(Interval a, Interval b) {
    real least = upper_angle(b.hi < 0.0 ? a.hi : a.lo, b.hi);
    real most = upper_angle(b.lo < 0.0 ? a.lo : a.hi, b.lo);
    return widened_by_rounding(least, most, 64.0);
}

// Returns the angles from -pi to pi of points (x, y), x in b and y in a. They are all angles where the rectangle meets
// the cut, y = 0 and x <= 0, from below, or is too near the origin or too far from it.
Interval interval_atan2(Interval a, Interval b) {
    real largest = INTERVAL_LARGEST_DIVISOR;
    bool usable = interval_magnitude(a) < largest && interval_magnitude(b) < largest
                  && max(interval_mignitude(a), interval_mignitude(b)) > REAL_TINY;
    if (usable && a.lo >= 0.0) return upper_angles(a, b);
    if (usable && (a.hi < 0.0 || (a.hi == 0.0 && b.lo > 0.0))) return interval_neg(upper_angles(interval_neg(a), b));
    if (usable && b.lo > 0.0) {
        real most = upper_angle(a.hi, b.lo);
        real least = upper_angle(-a.lo, b.lo);
        return widened_by_rounding(-least, most, 64.0);
    }
    return widened_by_rounding(-INTERVAL_PI - INTERVAL_PI_REST, INTERVAL_PI + INTERVAL_PI_REST, 4.0);
}

// Returns 1 if the rectangle crosses the cut away from the origin, where the angle jumps from pi to -pi, else 0.
int open_atan2(Interval a, Interval b) {
    bool crossing = a.lo < 0.0 && a.hi >= 0.0 && b.hi < -REAL_TINY;
    return crossing && interval_magnitude(a) < INTERVAL_LARGEST_DIVISOR && b.lo > -INTERVAL_LARGEST_DIVISOR ? 1 : 0;
}

// Returns the angles on and above the cut or those below it, as `sides` says; all of them for -1.
Interval sided_atan2(Interval a, Interval b, int sides, int open) {
    if (sides < 0 || open_atan2(a, b) == 0) return interval_atan2(a, b);
    if (((sides >> open) & 1) == 1) return upper_angles(make_interval(0.0, a.hi), b);
    return interval_neg(upper_angles(make_interval(0.0, -a.lo), b));
}
