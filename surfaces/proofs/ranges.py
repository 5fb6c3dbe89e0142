"""Run a tape on many boxes at once: enclosures of every operation's values, as pairs of numpy arrays."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surfaces.tape import LEAVES, POWERS, Tape

Floats = NDArray[np.float64]
Pair = tuple[Any, Any]  # lower and upper ends: float64[n], or one number for all boxes
_SLACK = 2.0**-44  # relative error of numpy's elementary functions; its tests allow 2^-50


def bracket(value: Fraction) -> tuple[float, float]:
    """Return two floats, equal if `value` is one, that hold a rational number between them."""
    near = float(value)
    exact = Fraction(near)
    if exact == value:
        return near, near
    return (near, math.nextafter(near, math.inf)) if exact < value else (math.nextafter(near, -math.inf), near)


def _down(a: Any) -> Any:
    return np.nextafter(a, -np.inf)


def _up(a: Any) -> Any:
    return np.nextafter(a, np.inf)


def _padded(low: Any, high: Any) -> Pair:
    """Return a pair that is wider by the errors of elementary functions."""
    return low - np.abs(low) * _SLACK - 1e-300, high + np.abs(high) * _SLACK + 1e-300


class Ranges:
    """Define the number system of pairs of ends. A NaN end says that nothing is known of the values.

    A pair holds all values that the exact function has on the box. Where a function has no value it adds none: the root
    of [-1, 4] is [0, 2].
    """

    def const(self, value: Fraction) -> Pair:
        return bracket(value)

    def pi(self) -> Pair:
        return _down(math.pi), _up(math.pi)

    def e(self) -> Pair:
        return _down(math.e), _up(math.e)

    def neg(self, a: Pair) -> Pair:
        return -a[1], -a[0]

    def add(self, a: Pair, b: Pair) -> Pair:
        return _down(a[0] + b[0]), _up(a[1] + b[1])

    def sub(self, a: Pair, b: Pair) -> Pair:
        return _down(a[0] - b[1]), _up(a[1] - b[0])

    def mul(self, a: Pair, b: Pair) -> Pair:
        p, q, r, s = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
        low, high = np.minimum(np.minimum(p, q), np.minimum(r, s)), np.maximum(np.maximum(p, q), np.maximum(r, s))
        return _down(low), _up(high)

    def div(self, a: Pair, b: Pair) -> Pair:
        known = (b[0] > 0.0) | (b[1] < 0.0)
        return self.mul(a, (np.where(known, _down(1.0 / b[1]), np.nan), np.where(known, _up(1.0 / b[0]), np.nan)))

    def _even(self, low: Any, high: Any, a: Pair) -> Pair:
        """Return the pair of an even function with its ends' values `low` and `high`."""
        around = (a[0] <= 0.0) & (a[1] >= 0.0)
        return np.where(around, 0.0, np.maximum(_down(np.minimum(low, high)), 0.0)), _up(np.maximum(low, high))

    def sqr(self, a: Pair) -> Pair:
        return self._even(a[0] * a[0], a[1] * a[1], a)

    def powi(self, a: Pair, n: int) -> Pair:
        low, high = _padded(a[0] ** n, a[1] ** n) if n % 2 else (a[0] ** n, a[1] ** n)
        if n % 2:
            return low, high
        low, high = self._even(low, high, a)
        return np.maximum(low * (1.0 - _SLACK) - 1e-300, 0.0), high * (1.0 + _SLACK) + 1e-300

    def abs(self, a: Pair) -> Pair:
        return np.maximum(np.maximum(a[0], -a[1]), 0.0), np.maximum(-a[0], a[1])

    def min(self, a: Pair, b: Pair) -> Pair:
        return np.minimum(a[0], b[0]), np.minimum(a[1], b[1])

    def max(self, a: Pair, b: Pair) -> Pair:
        return np.maximum(a[0], b[0]), np.maximum(a[1], b[1])

    def sqrt(self, a: Pair) -> Pair:
        low, high = np.sqrt(np.maximum(a[0], 0.0)), np.sqrt(np.maximum(a[1], 0.0))
        return np.maximum(_down(low), 0.0), _up(high)

    def powr(self, a: Pair, q: Fraction) -> Pair:
        low, high = _padded(np.maximum(a[0], 0.0) ** float(q), np.maximum(a[1], 0.0) ** float(q))
        return np.maximum(low, 0.0), high

    def exp(self, a: Pair) -> Pair:
        low, high = _padded(np.exp(a[0]), np.exp(a[1]))
        return np.maximum(low, 0.0), high

    def log(self, a: Pair) -> Pair:
        return _padded(np.log(np.maximum(a[0], 0.0)), np.log(np.maximum(a[1], 0.0)))

    def sin(self, a: Pair) -> Pair:
        return self._wave(np.sin, a, 0.25)

    def cos(self, a: Pair) -> Pair:
        return self._wave(np.cos, a, 0.0)

    def _wave(self, function: Any, a: Pair, crest: float) -> Pair:
        """Return the range of sin or cos, whose first crest is at `crest` turns."""
        slack = 1e-12 * (1.0 + np.maximum(np.abs(a[0]), np.abs(a[1])))
        first, last = (a[0] - slack) / (2.0 * math.pi) - crest, (a[1] + slack) / (2.0 * math.pi) - crest
        at_ends = function(a[0]), function(a[1])
        high = np.where(np.floor(last) > np.floor(first), 1.0, np.maximum(*at_ends) + slack)
        low = np.where(np.floor(last - 0.5) > np.floor(first - 0.5), -1.0, np.minimum(*at_ends) - slack)
        return np.maximum(low, -1.0), np.minimum(high, 1.0)

    def tan(self, a: Pair) -> Pair:
        cosine = self.cos(a)
        far = (cosine[0] <= 0.0) & (cosine[1] >= 0.0) | (a[1] - a[0] >= 3.0)
        low, high = _padded(np.tan(a[0]), np.tan(a[1]))
        slack = 1e-10 * (1.0 + np.abs(low) + np.abs(high)) ** 2 * (1.0 + np.maximum(np.abs(a[0]), np.abs(a[1])))
        return np.where(far, np.nan, low - slack), np.where(far, np.nan, high + slack)

    def floor(self, a: Pair) -> Pair:
        return np.floor(a[0]), np.floor(a[1])

    def atan2(self, a: Pair, b: Pair) -> Pair:
        smooth = (b[0] > 0.0) | (a[0] > 0.0) | (a[1] < 0.0)  # the box holds neither the origin nor the cut
        at = [np.arctan2(y, x) for y in a for x in b]
        low, high = _padded(np.minimum.reduce(at), np.maximum.reduce(at))
        return np.where(smooth, low, _down(-math.pi)), np.where(smooth, high, _up(math.pi))

    def below(self, a: Pair, b: Pair) -> Pair:
        return np.where(a[1] <= b[0], 1.0, 0.0), np.where(a[0] > b[1], 0.0, 1.0)

    def sign(self, a: Pair) -> Pair:
        return np.where(a[0] >= 0.0, 1.0, -1.0), np.where(a[1] < 0.0, -1.0, 1.0)

    def select(self, c: Pair, p: Pair, q: Pair) -> Pair:
        first, second = c[0] > 0.0, c[1] < 1.0  # c is 0 or 1, and its pair may be a rounding wider
        either = np.minimum(p[0], q[0]), np.maximum(p[1], q[1])
        return tuple(np.where(first, p[k], np.where(second, q[k], either[k])) for k in (0, 1))  # type: ignore[return-value]


_SYSTEM = Ranges()


def run(tape: Tape, box: Mapping[str, Pair]) -> Iterator[Pair]:
    """Yield the pair of each operation of a tape, in its order, on boxes [n] of the variables."""
    values: list[Pair] = []
    for op in tape.ops:
        if op.name == "var":
            value: Pair = box[op.args[0]]
        elif op.name in LEAVES:
            value = getattr(_SYSTEM, op.name)(*op.args)
        elif op.name in POWERS:
            value = getattr(_SYSTEM, op.name)(values[op.args[0]], op.args[1])
        else:
            value = getattr(_SYSTEM, op.name)(*(values[i] for i in op.args))
        values.append(value)
        yield value


def has_value(name: str, argument: Pair) -> NDArray[np.bool_]:
    """Return on which boxes the range of its argument proves that an operation has a value: bool, or bool[n]."""
    low, high = argument
    if name in ("sqrt", "powr"):
        return np.asarray(low >= 0.0)
    if name == "log":
        return np.asarray(low > 0.0)
    if name == "tan":
        low, high = Ranges().cos(argument)
    return np.asarray((low > 0.0) | (high < 0.0))


def sides(lower: Floats, upper: Floats) -> dict[str, Pair]:
    """Return boxes float64[n, 3] as the pairs of x, y, z."""
    return {axis: (lower[:, k], upper[:, k]) for k, axis in enumerate("xyz")}


def outputs(tape: Tape, lower: Floats, upper: Floats) -> tuple[Floats, Floats]:
    """Enclose a tape's outputs on boxes float64[n, 3]: lower and upper ends, float64[n, outputs]; NaN where unknown."""
    with np.errstate(all="ignore"):
        values = list(run(tape, sides(lower, upper)))
    ends = (np.stack([np.broadcast_to(values[i][k], len(lower)) for i in tape.outputs], axis=1) for k in (0, 1))
    low, high = ends
    return low, high
