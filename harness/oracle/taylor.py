"""Enclose f and its slope on a piece of a ray by Taylor series, where f's large terms cancel.

**Theory.** A range takes each term by itself, so that of cos² + sin² − 1 + y/10⁹ it is as wide as the piece, and
cutting helps little. A Taylor series at the piece's middle adds up the terms' coefficients first, and there what
cancels does, up to rounding. With t = m + r·s, and s from −1 to 1, f(t) = Σ c_k s^k + C s^N for k < N, where C is the
N-th coefficient at some point of the piece. The series on the whole piece encloses C, and its dependencies count
little, since C has the factor r^N / N!. In the same way f' = (Σ k c_k s^(k−1) + N C s^(N−1)) / r.

A minimum, a floor or a choice that is not proved to be on one side all over the piece leaves f's slope open. A root, a
power or a logarithm whose argument is not proved to be positive leaves all open.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from functools import reduce
from operator import add
from typing import Any

from flint import arb, arb_series, ctx, fmpq

from harness.oracle import reals
from harness.oracle.dual import Dual
from harness.oracle.program import Functions, Program

ORDER = 18  # N
BITS = 192


class _Rough(Exception):
    """Report that f has no series on a piece, as far as is proved."""


class Model:
    """Hold a function of s on a piece: its series about the middle, and its series over the whole piece.

    One that is not `smooth` is at each s the value there of one of the functions that the series hold, not of the same.
    """

    __slots__ = ("at", "over", "smooth")

    def __init__(self, at: Any, over: Any, smooth: bool) -> None:
        self.at = at
        self.over = over
        self.smooth = smooth

    def __add__(self, other: Model) -> Model:
        return Model(self.at + other.at, self.over + other.over, self.smooth and other.smooth)

    def __sub__(self, other: Model) -> Model:
        return Model(self.at - other.at, self.over - other.over, self.smooth and other.smooth)

    def __neg__(self) -> Model:
        return Model(-self.at, -self.over, self.smooth)

    def __mul__(self, other: Model) -> Model:
        return Model(self.at * other.at, self.over * other.over, self.smooth and other.smooth)

    def __truediv__(self, other: Model) -> Model:
        return Model(self.at / other.at, self.over / other.over, self.smooth and other.smooth)

    def of(self, name: str) -> Model:
        """Return an analytic function of this one."""
        return Model(getattr(self.at, name)(), getattr(self.over, name)(), self.smooth)

    def coefficients(self) -> list[Any]:
        """Return c_0 to c_(N−1), and C."""
        return [*(self.at[k] for k in range(ORDER)), self.over[ORDER]]

    def range(self) -> Any:
        """Enclose the values on the piece."""
        first, *others = self.coefficients()
        return first + _around(sum(map(abs, others), arb(0)))

    def slope(self) -> Any:
        """Enclose the derivative by s on the piece; NaN where the function is not smooth."""
        if not self.smooth:
            return arb.nan()
        c = self.coefficients()
        return c[1] + _around(sum((k * abs(c[k]) for k in range(2, ORDER + 1)), arb(0)))

    def sign(self) -> int:
        """Return the sign on the piece, 0 if it is not known."""
        values = self.range()
        return 1 if values > 0 or self.over[0] > 0 else -1 if values < 0 or self.over[0] < 0 else 0


def enclosed(program: Program, constants: Sequence[Any], axes: Sequence[tuple[Any, Any]], whole: Any) -> Dual:
    """Enclose f and its slope in t, two flint.arb, over the ball `whole`; NaN where nothing is known.

    `axes` holds o and d of x, y and z, and `constants` are the program's. All are flint.arb.
    """
    middle, radius = whole.mid(), whole.rad()
    try:
        with _length(ORDER + 1):
            lines = ([arb_series([o + d * t, d * radius]) for t in (middle, whole)] for o, d in axes)
            inputs = [Model(at, over, True) for at, over in lines]
            f = program.run(inputs, [_constant(c) for c in constants], FUNCTIONS)
            return Dual(f.range(), f.slope() / radius)
    except (_Rough, ValueError, ZeroDivisionError):
        return Dual(arb.nan(), arb.nan())


def _constant(value: Any, smooth: bool = True) -> Model:
    """Return a ball, of which one number is the value all over the piece if that is `smooth`."""
    return Model(arb_series([value]), arb_series([value]), smooth)


def _around(size: Any) -> Any:
    """Return the ball of what is not larger than `size`."""
    return arb(0, 1) * size


@contextmanager
def _length(terms: int) -> Iterator[None]:
    """Set the number of terms of series inside a with statement."""
    before = ctx.cap
    ctx.cap = terms
    try:
        yield
    finally:
        ctx.cap = before


def _positive(a: Model) -> Model:
    """Return what is positive on the piece. Raises _Rough if it is not proved to be."""
    if a.sign() <= 0:
        raise _Rough
    return a


def _by_ranges(name: str, *models: Model) -> Model:
    """Return a function's values, of which no more is known than that they lie in its range."""
    return _constant(reals.FUNCTIONS[name](*(m.range() for m in models)), smooth=False)


def _powr(a: Model, exponent: Fraction) -> Model:
    return (_positive(a).of("log") * _constant(arb(fmpq(exponent.numerator, exponent.denominator)))).of("exp")


def _atan2(y: Model, x: Model) -> Model:
    if x.sign() > 0:
        return (y / x).of("atan")
    side = y.sign()
    return _constant(side * arb.pi() / 2) - (x / y).of("atan") if side else _by_ranges("atan2", y, x)


def _absolute(a: Model) -> Model:
    side = a.sign()
    return a if side > 0 else -a if side < 0 else _by_ranges("abs", a)


def _extreme(name: str) -> Callable[[Model, Model], Model]:
    def extreme(a: Model, b: Model) -> Model:
        ahead = (b - a).sign() * (1 if name == "min" else -1)
        return a if ahead > 0 else b if ahead < 0 else _by_ranges(name, a, b)

    return extreme


def _floor(a: Model) -> Model:
    value = reals.floor(a.range())
    return _constant(value, smooth=value.is_exact())


def _below(a: Model, b: Model) -> Model:
    side = (b - a).sign()
    return _constant(arb(int(side > 0))) if side else _by_ranges("below", a, b)


def _select(c: Model, p: Model, q: Model) -> Model:
    side = (c - _constant(arb(0.5))).sign()
    return p if side > 0 else q if side < 0 else _by_ranges("select", c, p, q)


FUNCTIONS: Functions = {
    **{name: lambda a, name=name: a.of(name) for name in ("exp", "sin", "cos", "tan")},
    "sqrt": lambda a: _positive(a).of("sqrt"),
    "log": lambda a: _positive(a).of("log"),
    "powr": _powr,
    "length": lambda *parts: _positive(reduce(add, (p * p for p in parts))).of("sqrt"),
    "abs": _absolute,
    "min": _extreme("min"),
    "max": _extreme("max"),
    "floor": _floor,
    "below": _below,
    "select": _select,
    "atan2": _atan2,
}
