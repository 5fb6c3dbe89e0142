"""Compute with balls on float64 arrays: a midpoint and a radius that provably hold the exact value.

**Theory.** Rounding to nearest gives fl(a∘b) = (a∘b)(1 + e) + n with |e| <= u = 2^-53 and |n| <= 2^-1074 for + − × ÷ √
(IEEE 754; n = 0 for + and −). A radius is computed from at most eight sums and products of non-negative floats, so that
it is too small by at most the factor (1 − u)^8; multiplying it by GROW = 1 + 2^-48 and adding TINY repairs that. For
the rounding of the midpoint 2^-52 of it are added to the radius, twice the bound. Overflow gives radii that are NaN or
infinite, which no comparison accepts.

Elementary functions are numpy's, with an error of ELEMENTARY = 2^-46 of the result; numpy's own tests allow 4 units in
the last place (2^-50). Nowhere else does the oracle trust a library beyond IEEE 754. `powr` and `atan2` take their
bounds from the ends of a range and the corners of a box, since they are monotone from end to end and from corner to
corner.

Where a ball of a floor, a comparison or a select leaves open on which side of a jump its members lie, it holds the
values of both sides, and its slope is NaN.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.oracle.program import Functions

Floats = NDArray[np.float64]
UNIT = 2.0**-52
GROW = 1.0 + 2.0**-48
TINY = 2.0**-1000
ELEMENTARY = 2.0**-46
PI_ABOVE = float(np.nextafter(np.pi, 4.0))


class Balls:
    """Hold balls: arrays of midpoints and radii of one shape [...], or one number each.

    Operations go number by number, as numpy's do; their results have the shape to which numpy broadcasts the operands.

    The result of every operation holds the exact results for all members of its operands.
    """

    __slots__ = ("mid", "rad")

    def __init__(self, mid: Any, rad: Any = 0.0) -> None:
        self.mid = mid
        self.rad = rad

    def __add__(self, other: Balls) -> Balls:
        mid = self.mid + other.mid
        return Balls(mid, (self.rad + other.rad + UNIT * np.abs(mid)) * GROW)

    def __sub__(self, other: Balls) -> Balls:
        mid = self.mid - other.mid
        return Balls(mid, (self.rad + other.rad + UNIT * np.abs(mid)) * GROW)

    def __neg__(self) -> Balls:
        return Balls(-self.mid, self.rad)

    def __mul__(self, other: Balls) -> Balls:
        mid = self.mid * other.mid
        spread = np.abs(self.mid) * other.rad + self.rad * (np.abs(other.mid) + other.rad)
        return Balls(mid, (spread + UNIT * np.abs(mid)) * GROW + TINY)

    def __truediv__(self, other: Balls) -> Balls:
        """Return the quotient [...]; its radius is NaN where the divisor's ball holds 0.

        The radius follows from |a/b − ma/mb| <= (ra + |ma/mb| rb) / (|mb| − rb).
        """
        mid = self.mid / other.mid
        room = np.abs(other.mid) * (1.0 - 2.0**-50) - other.rad
        spread = (self.rad + np.abs(mid) * other.rad * GROW) / np.where(room > 0.0, room, np.nan)
        return Balls(mid, (spread + UNIT * np.abs(mid)) * GROW + TINY)

    @property
    def lower(self) -> Any:
        """Return float64[...] that is not above any member."""
        return (self.mid - self.rad) - (np.abs(self.mid) + self.rad) * UNIT

    @property
    def upper(self) -> Any:
        """Return float64[...] that is not below any member."""
        return (self.mid + self.rad) + (np.abs(self.mid) + self.rad) * UNIT

    @property
    def sign(self) -> NDArray[np.int8]:
        """Return int8[...]: +1 or −1 where the whole ball has that sign, else 0."""
        return np.asarray(self.mid > self.rad).astype(np.int8) - np.asarray(self.mid < -self.rad).astype(np.int8)

    @property
    def excludes_zero(self) -> NDArray[np.bool_]:
        """Return bool[...]: whether the ball does not hold 0."""
        return np.asarray(np.abs(self.mid) > self.rad)


def hull(lower: Any, upper: Any) -> Balls:
    """Return balls [...] that hold the intervals from `lower` to `upper`, each [...]."""
    mid = 0.5 * (lower + upper)
    return Balls(mid, (np.maximum(upper - mid, mid - lower) + UNIT * np.abs(mid)) * GROW + TINY)


def sqrt(a: Balls) -> Balls:
    """Enclose the square roots, [...], of the members that are not negative; NaN where all are negative."""
    lower, upper = np.sqrt(np.maximum(a.lower, 0.0)), np.sqrt(a.upper)
    return hull(lower * (1.0 - UNIT), upper * (1.0 + UNIT))


def square(a: Balls) -> Balls:
    """Enclose the squares, [...], which are not negative: a ball about 0 gives one that ends there."""
    plain = a * a
    around = np.abs(a.mid) < a.rad
    if not np.any(around):
        return plain
    reach = np.abs(a.mid) + a.rad
    return where(around, hull(0.0, reach * reach * GROW + TINY), plain)


def length(*parts: Balls) -> Balls:
    """Enclose the square root, [...], of the sum of the squares."""
    total = square(parts[0])
    for part in parts[1:]:
        total = total + square(part)
    return sqrt(total)


def exp(a: Balls) -> Balls:
    """Enclose the exponentials, [...]."""
    mid = np.exp(a.mid)
    return Balls(mid, mid * (np.expm1(a.rad) * (1.0 + ELEMENTARY) + ELEMENTARY) * GROW + TINY)


def log(a: Balls) -> Balls:
    """Enclose the logarithms, [...]; the radius is NaN or infinite where a member is not positive."""
    lower, upper = np.log(a.lower), np.log(a.upper)
    wide = hull(lower, upper)
    return Balls(wide.mid, (wide.rad + ELEMENTARY * np.maximum(np.abs(lower), np.abs(upper))) * GROW + TINY)


def _bounded(mid: Any, rad: Any) -> Balls:
    """Return balls [...] about values `mid` of sin or cos, whose slope and size are at most 1."""
    return Balls(mid, np.minimum((rad + ELEMENTARY * np.abs(mid)) * GROW + TINY, 2.0))


def sin(a: Balls) -> Balls:
    """Enclose the sines, [...]."""
    return _bounded(np.sin(a.mid), a.rad)


def cos(a: Balls) -> Balls:
    """Enclose the cosines, [...]."""
    return _bounded(np.cos(a.mid), a.rad)


def tan(a: Balls) -> Balls:
    """Enclose the tangents, [...]; the radius is NaN where the cosine may be 0."""
    return sin(a) / cos(a)


def absolute(a: Balls) -> Balls:
    """Enclose the absolute values, [...]."""
    return Balls(np.abs(a.mid), a.rad)


def minimum(a: Balls, b: Balls) -> Balls:
    """Enclose the lesser of two numbers, [...], by |min(a, b) − min(ma, mb)| <= max(ra, rb)."""
    return Balls(np.minimum(a.mid, b.mid), _radius_of_one(b - a, a, b))


def maximum(a: Balls, b: Balls) -> Balls:
    """Enclose the greater of two numbers, [...], as `minimum` encloses the lesser."""
    return Balls(np.maximum(a.mid, b.mid), _radius_of_one(a - b, a, b))


def _radius_of_one(ahead: Balls, a: Balls, b: Balls) -> Any:
    """Return the radius of `a` where `ahead` > 0, that of `b` where `ahead` < 0, else the larger one."""
    larger = np.maximum(a.rad, b.rad)
    return np.where(ahead.mid > ahead.rad, a.rad, np.where(ahead.mid < -ahead.rad, b.rad, larger))


def pick(sign: Balls, a: Balls, b: Balls) -> Balls:
    """Return balls [...]: `a` where `sign` is 1, `b` where it is −1, else a ball that holds both."""
    open_ = sign.rad > 0.0
    both = hull(np.minimum(a.lower, b.lower), np.maximum(a.upper, b.upper))
    first = sign.mid > 0.0
    return Balls(
        np.where(open_, both.mid, np.where(first, a.mid, b.mid)),
        np.where(open_, both.rad, np.where(first, a.rad, b.rad)),
    )


def share(part: Balls, whole: Balls) -> Balls:
    """Enclose part / whole, [...], where |part| <= whole is known, so that the result never leaves [−1, 1]."""
    quotient = part / whole
    lower, upper = np.fmax(quotient.lower, -1.0), np.fmin(quotient.upper, 1.0)
    lower, upper = np.where(lower <= upper, lower, -1.0), np.where(lower <= upper, upper, 1.0)
    known = np.isfinite(part.mid) & np.isfinite(part.rad)
    return hull(np.where(known, lower, np.nan), np.where(known, upper, np.nan))


def sign_range(a: Balls) -> Balls:
    """Return the generalised derivative of abs, balls [...]: ±1, or [−1, 1] where the sign is not known."""
    sign = a.sign
    return Balls(sign.astype(np.float64), np.where(sign == 0, 1.0, 0.0))


def scale(a: Balls, factor: Fraction) -> Balls:
    """Enclose `factor` times the members, [...]."""
    rounded = factor.numerator / factor.denominator
    return a * Balls(rounded, UNIT * abs(rounded))


def powr(a: Balls, exponent: Fraction) -> Balls:
    """Enclose the powers, [...], to a positive exponent, of the members that are not negative; NaN where all are.

    The exponent is rounded to float64, which changes the power by at most its logarithm times 2^-53.
    """
    e = exponent.numerator / exponent.denominator
    ends = np.maximum(a.lower, 0.0), a.upper
    low, high = (np.power(end, e) for end in ends)
    low_error, high_error = (ELEMENTARY + UNIT * e * np.abs(np.log(end)) for end in ends)
    low = np.where(low > 0.0, low * (1.0 - low_error) * (1.0 - UNIT) - TINY, low)
    high = np.where(high > 0.0, high * (1.0 + high_error) * GROW + TINY, high)
    return hull(low, high)


def floor(a: Balls) -> Balls:
    """Enclose the greatest whole numbers that are not above the members, [...]; exactly where there is only one."""
    low, high = floors(a)
    one = (low == high) & np.isfinite(low)
    return where(one, Balls(low), hull(low, high))


def floors(a: Balls) -> tuple[Any, Any]:
    """Return the floors of the ends, float64[...] each."""
    exact = np.asarray(a.rad) == 0.0
    return np.floor(np.where(exact, a.mid, a.lower)), np.floor(np.where(exact, a.mid, a.upper))


def below(a: Balls, b: Balls) -> Balls:
    """Return balls [...]: 1 where a <= b, 0 where a > b, else [0, 1]."""
    gap = b - a
    yes, no = np.asarray(gap.lower >= 0.0), np.asarray(gap.upper < 0.0)
    return Balls(np.where(yes, 1.0, np.where(no, 0.0, 0.5)), np.where(yes | no, 0.0, 0.5))


def select(c: Balls, p: Balls, q: Balls) -> Balls:
    """Enclose p where the condition c, which is 1 or 0, holds, q where it does not, both where that is open; [...]."""
    yes, no = c.lower > 0.5, c.upper < 0.5
    both = hull(np.minimum(p.lower, q.lower), np.maximum(p.upper, q.upper))
    return where(yes, p, where(no, q, both))


def select_slope(c: Balls, p: Balls, q: Balls) -> Balls:
    """Return the slope of a select, balls [...]; NaN where c leaves open which part is taken."""
    return where(c.lower > 0.5, p, where(c.upper < 0.5, q, Balls(np.nan, np.nan)))


def step_slope(value: Balls) -> Balls:
    """Return the slope of what is constant between jumps, balls [...]: 0 where `value` is one number, else NaN."""
    steady = np.where(np.asarray(value.rad) == 0.0, 0.0, np.nan)
    return Balls(steady, steady)


def atan2(y: Balls, x: Balls) -> Balls:
    """Enclose the angles, [...], of the points (x, y)."""
    ends = y.lower, y.upper
    return where(meets_cut(y, x), Balls(0.0, PI_ABOVE), angles(*ends, x))


def meets_cut(y: Balls, x: Balls) -> Any:
    """Return bool[...]: whether a box may meet the half line y = 0, x <= 0 and leave it."""
    on_cut = (np.asarray(y.mid) == 0.0) & (np.asarray(y.rad) == 0.0) & (x.upper < 0.0)
    return ~((y.lower > 0.0) | (y.upper < 0.0) | (x.lower > 0.0) | on_cut)  # the bounds that `angles` takes


def angles(low: Any, high: Any, x: Balls) -> Balls:
    """Enclose the angles, [...], of boxes that do not meet the cut from below, with y from `low` to `high`.

    Along each side of such a box the angle is monotone, so that corners bound it. Where y begins at 0 the cut itself
    may belong to the box, with the angle π.
    """
    corners = [np.arctan2(v + 0.0, h + 0.0) for v in (low, high) for h in (x.lower, x.upper)]
    least, most = corners[0], corners[0]
    for corner in corners[1:]:
        least, most = np.minimum(least, corner), np.maximum(most, corner)
    wide = hull(least, most)
    return Balls(wide.mid, (wide.rad + ELEMENTARY * np.maximum(np.abs(least), np.abs(most))) * GROW + TINY)


def atan2_slope(y: Balls, x: Balls, dy: Balls, dx: Balls) -> Balls:
    """Enclose the derivatives of atan2, [...]; NaN where the box may meet the cut."""
    slope = (x * dy - y * dx) / (square(x) + square(y))
    return where(meets_cut(y, x), Balls(np.nan, np.nan), slope)


def where(first: Any, a: Balls, b: Balls) -> Balls:
    """Return balls [...]: `a` where `first`, bool[...], holds, else `b`."""
    return Balls(np.where(first, a.mid, b.mid), np.where(first, a.rad, b.rad))


FUNCTIONS: Functions = {
    "sqrt": sqrt, "exp": exp, "log": log, "sin": sin, "cos": cos, "tan": tan,
    "abs": absolute, "min": minimum, "max": maximum, "sign": sign_range, "scale": scale, "sqr": square,
    "length": length, "pick": pick, "share": share,
    "floor": floor, "powr": powr, "atan2": atan2, "below": below, "select": select,
    "step_slope": step_slope, "select_slope": select_slope, "atan2_slope": atan2_slope,
}  # fmt: skip
